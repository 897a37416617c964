// A plot in SVG: axes with round ticks, curves, and marks for means and spans.
#pragma once

#include "io/svg.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace riesel::io {

struct Interval {
  double low, high;  ///< low < high
};

/// The range of the finite values, a little wider; around a single value, or [0, 1] for none.
Interval range_of(std::span<const double> values);

/// At least one and at most `most` >= 2 multiples of 1, 2 or 5 times a power of ten within the
/// range, ascending.
std::vector<double> ticks(Interval range, int most);

/// A curve of which no more can be seen: of the points that fall into one of `columns` >= 1 columns
/// of equal width from the first point to the last only the first, the lowest, the highest and the
/// last are kept. x ascends.
std::vector<Point> thinned(std::span<const Point> points, std::size_t columns);

struct Axis {
  std::string label;
  Interval range;
};

class Plot {
public:
  /// Draws the axes. Lengths in pixels.
  Plot(double width, double height, std::string_view description, Axis x, Axis y);

  /// The place of a pair of values.
  Point at(double x, double y) const;

  /// A line through all pairs, x ascending; more of them than pixels are thinned. Pairs that are
  /// not finite are gaps.
  void curve(std::span<const double> x, std::span<const double> y, const Style& style);
  /// What lies within the axes of a rectangle or a straight line.
  void area(Interval x, Interval y, const Style& style);
  void level(Interval x, double y, const Style& style);
  void moment(double x, std::string_view label, const Style& style);

  const Axis& x() const { return x_; }
  const Axis& y() const { return y_; }
  const Svg& svg() const { return svg_; }

private:
  void draw_axes();

  Axis x_, y_;
  double right_, bottom_;  // of the frame
  Svg svg_;
};

}  // namespace riesel::io
