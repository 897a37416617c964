// A plot in SVG: axes with round ticks, linear or logarithmic; curves, symbols with error bars,
// marks for means and spans, and a legend.
#pragma once

#include "io/axis.hpp"
#include "io/svg.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace riesel::io {

/// A curve of which no more can be seen: of the points that fall into one of `columns` >= 1 columns
/// of equal width from the first point to the last only the first, the lowest, the highest and the
/// last are kept. x ascends.
std::vector<Point> thinned(std::span<const Point> points, std::size_t columns);

enum class Symbol { disc, square, triangle, diamond };

/// What a curve is recognised by.
struct Look {
  std::string_view colour;
  Symbol symbol = Symbol::disc;
  std::string_view dashes{};
};

/// A different one for each small index; they begin again after 8 colours.
Look look_of(std::size_t index);

class Plot {
public:
  /// Draws the axes. Lengths in pixels.
  Plot(double width, double height, std::string_view description, Axis x, Axis y);

  /// The place of a pair of values. A value that a logarithmic axis does not have is not finite.
  Point at(double x, double y) const;

  /// A line through all pairs, x ascending; more of them than pixels are thinned. Pairs that are
  /// not finite are gaps; one between two gaps is a small disc, open where the line is dashed.
  void curve(std::span<const double> x, std::span<const double> y, const Style& style);
  /// What lies within the axes of a rectangle or a straight line.
  void area(Interval x, Interval y, const Style& style);
  void level(Interval x, double y, const Style& style);
  /// From the label down to the axis. Labels of neighbours stand in rows of their own, counted from
  /// the top, those of larger x above: they point to where there is room, and cross no line.
  void moment(double x, std::string_view label, const Style& style, int row = 0);

  /// Nothing for what is not known.
  void error_bar(double x, double y, double error, std::string_view colour);
  /// A value with its error, if that is known; full or open. Nothing for a value that is not known.
  void measured(double x, double y, double error, const Look& look, bool is_full);
  /// Beside a value: it still grows.
  void arrow_up(double x, double y, const Look& look);
  /// Over a value: it is not to be used.
  void cross(double x, double y, const Look& look);
  /// Below the axes: what all share, if that is not empty, and each name with its look, as a symbol
  /// on a line. Grows the drawing. For once.
  void legend(std::string_view shared, const std::vector<std::pair<std::string, Look>>& entries,
              bool with_symbols);

  const Axis& x() const { return x_; }
  const Axis& y() const { return y_; }
  const Svg& svg() const { return svg_; }
  Svg& svg() { return svg_; }  ///< to put what comes next into a link or a group

private:
  void draw_axes();
  void draw_single(Point place, const Style& style);
  void draw_symbol(Point place, const Look& look, bool is_full);

  Axis x_, y_;
  double right_, bottom_;  // of the frame
  Svg svg_;
};

}  // namespace riesel::io
