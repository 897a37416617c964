// Drawings in SVG: the few shapes that figures need, with the style written out at each shape or
// group, so that a drawing looks the same in a page and in a file of its own.
//
// Lengths are pixels, y points down. Numbers are written with two decimals: equal drawings are
// equal texts.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace riesel::io {

/// Near the beginning of each file of a drawing, before the version of riesel: tells it from files
/// of others.
inline constexpr std::string_view mark_of_drawings = "<!-- Drawn by riesel ";

struct Point {
  double x, y;
};

/// What is left empty is inherited from the group, or from SVG's defaults (black, no stroke).
struct Style {
  std::string_view fill{};       ///< colour, or "none"
  std::string_view stroke{};     ///< colour
  double stroke_width = 0.0;     ///< 0: not given
  std::string_view dashes{};     ///< "4 3"
  std::string_view anchor{};     ///< of text: "start", "middle", "end"
  std::string_view font_size{};  ///< of text, in pixels
};

/// Members throw std::invalid_argument for a coordinate that is not finite.
class Svg {
public:
  /// `description` is for readers who cannot see the drawing.
  Svg(double width, double height, std::string_view description);

  /// Makes the drawing higher by `height`, at its lower end.
  void extend(double height) { height_ += height; }

  /// Everything up to end_group() is in a group of this class and style. Groups may be nested.
  void begin_group(std::string_view name, const Style& style = {});
  void end_group();

  /// Everything up to end_link() is a link to `address`, with `tip` as its tooltip.
  void begin_link(std::string_view address, std::string_view tip);
  void end_link();

  void disc(Point centre, double radius, const Style& style = {});
  void line(Point from, Point to, const Style& style = {});
  void polyline(std::span<const Point> points, const Style& style = {});
  void polygon(std::span<const Point> points, const Style& style = {});
  void rectangle(Point corner, double width, double height, const Style& style = {});
  void text(Point at, std::string_view text, const Style& style = {});
  void upward_text(Point at, std::string_view text, const Style& style = {});

  /// As part of an HTML page.
  std::string element() const;
  /// As a file.
  std::string file() const;

private:
  std::string with_name_space(std::string_view name_space) const;

  double width_, height_;
  std::string description_, shapes_;
  bool has_links_ = false;
};

}  // namespace riesel::io
