// Axes of plots: a range that holds all values, linear or logarithmic, and round ticks on it.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace riesel::io {

struct Interval {
  double low, high;  ///< low < high
};

/// Whether the value lies in the range, its ends included.
bool contains(Interval range, double value);

enum class Scale { linear, logarithmic };

/// Logarithmic where all finite values are positive and the largest is more than 20 times the
/// smallest.
Scale scale_for(std::span<const double> values);

/// The range of the finite values, widened a little; [0, 1] if there are none. On a logarithmic
/// scale only positive values count, and without any the range is [1, 10].
Interval range_of(std::span<const double> values, Scale scale = Scale::linear);

/// Multiples of 1, 2 or 5 times a power of ten within the range, ascending: at least one, and at
/// most `most`, which must be at least 2.
std::vector<double> ticks(Interval range, int most);

/// Powers of ten within a positive range, or 1, 2 and 5 times them where it spans less than three
/// decades; those of ticks() if none lies within. At most ten.
std::vector<double> logarithmic_ticks(Interval range);

struct Axis {
  std::string label;
  Interval range;
  Scale scale = Scale::linear;
};

/// The axis that shows all of these values.
Axis axis_for(std::string label, std::span<const double> values);

/// The same axis with its upper end moved out by the fraction `part` of its length.
Axis with_room_above(Axis axis, double part);

/// Where a value lies on the axis: 0 at its lower end, 1 at its upper one. Not finite if a
/// logarithmic axis cannot show the value.
double part_of(const Axis& axis, double value);

/// The ticks that suit the scale of the axis; at most `most` of them if it is linear.
std::vector<double> ticks_of(const Axis& axis, int most);

}  // namespace riesel::io
