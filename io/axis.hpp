// Axes of plots: a range that holds all values, linear or logarithmic, and round ticks on it.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace riesel::io {

struct Interval {
  double low, high;  ///< low < high
};

/// With its ends.
bool contains(Interval range, double value);

enum class Scale { linear, logarithmic };

/// Logarithmic where all finite values are positive and spread over more than a factor of 20.
Scale scale_for(std::span<const double> values);

/// The range of the finite values, a little wider; around a single value, or [0, 1] for none. On a
/// logarithmic scale only positive values count, and for none it is [1, 10].
Interval range_of(std::span<const double> values, Scale scale = Scale::linear);

/// At least one and at most `most` >= 2 multiples of 1, 2 or 5 times a power of ten within the
/// range, ascending.
std::vector<double> ticks(Interval range, int most);

/// Powers of ten within a positive range, or 1, 2 and 5 times them where it spans less than
/// three decades; if there is none of them ticks(). At most ten.
std::vector<double> logarithmic_ticks(Interval range);

struct Axis {
  std::string label;
  Interval range;
  Scale scale = Scale::linear;
};

/// The axis that shows all of these values.
Axis axis_for(std::string label, std::span<const double> values);

/// The same axis with more room at its upper end: a part of its length.
Axis with_room_above(Axis axis, double part);

/// 0 at the lower end of the axis, 1 at its upper one. Not finite for what a logarithmic axis does
/// not have.
double part_of(const Axis& axis, double value);

/// Those of its scale, at most `most` on a linear one.
std::vector<double> ticks_of(const Axis& axis, int most);

}  // namespace riesel::io
