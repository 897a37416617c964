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

/// A curve without the points that could not be seen: of those in each of `columns` >= 1 columns of
/// equal width, from the first point to the last, only the first, the lowest, the highest and the
/// last are kept. x must ascend.
std::vector<Point> thinned(std::span<const Point> points, std::size_t columns);

enum class Symbol { disc, square, triangle, diamond };

/// What tells one curve from another.
struct Look {
  std::string_view colour;
  Symbol symbol = Symbol::disc;
};

/// A different one for each index below this number; then they begin again.
inline constexpr std::size_t different_looks = 8;
Look look_of(std::size_t index);

class Plot {
public:
  /// Draws the axes. Lengths in pixels.
  Plot(double width, double height, std::string_view description, Axis x, Axis y);

  /// Where a pair of values is drawn. Not finite if a logarithmic axis cannot show it.
  Point at(double x, double y) const;

  /// A line through all pairs, thinned if there are more of them than pixels; x must ascend. Pairs
  /// that are not finite make gaps; a pair between two gaps is a small disc, open if the line is
  /// dashed.
  void curve(std::span<const double> x, std::span<const double> y, const Style& style);
  /// The part within the axes of a rectangle or a horizontal line.
  void area(Interval x, Interval y, const Style& style);
  void level(Interval x, double y, const Style& style);
  /// A vertical line at x, from its label down to the axis. Neighbouring labels need different
  /// rows, counted from the top, that of the larger x above: then no label crosses a line where
  /// there is room for those of lower rows on the left. One in the top row is written towards the
  /// middle.
  void marker(double x, std::string_view label, const Style& style, int row = 0);

  /// Draws nothing if one of the numbers is unknown.
  void error_bar(double x, double y, double error, std::string_view colour);
  /// A value with its error bar, if the error is known; the symbol is filled or open. Draws nothing
  /// if the value is unknown.
  void measured(double x, double y, double error, const Look& look, bool is_full);
  /// An arrow above a value that is still growing.
  void arrow_up(double x, double y, const Look& look);
  /// A cross over a value that is not to be used.
  void cross(double x, double y, const Look& look);
  /// Below the axes: `shared`, which holds for all entries, if it is not empty, then each name with
  /// its look, a line with or without a symbol. Makes the drawing higher; to be called once.
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
