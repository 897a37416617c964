#include "io/axis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace riesel::io {
namespace {

/// The least and the greatest value that the scale can show; low > high if there are none.
Interval extremes_of(std::span<const double> values, Scale scale) {
  Interval found{HUGE_VAL, -HUGE_VAL};
  for (const double value : values) {
    if (!std::isfinite(value) || (scale == Scale::logarithmic && value <= 0.0)) continue;
    found.low = std::min(found.low, value);
    found.high = std::max(found.high, value);
  }
  return found;
}

/// log(high / low), where the ratio may be beyond all numbers.
double logarithmic_length(Interval range) { return std::log(range.high) - std::log(range.low); }

/// `value` exp(`room`), or the last number in that direction.
double grown(double value, double room) {
  using Limits = std::numeric_limits<double>;
  return std::clamp(std::exp(std::log(value) + room), Limits::min(), Limits::max());
}

}  // namespace

bool contains(Interval range, double value) { return value >= range.low && value <= range.high; }

Scale scale_for(std::span<const double> values) {
  constexpr double wide = 20.0;
  const auto [low, high] = extremes_of(values, Scale::linear);
  return low > 0.0 && high > wide * low ? Scale::logarithmic : Scale::linear;
}

Interval range_of(std::span<const double> values, Scale scale) {
  const auto [low, high] = extremes_of(values, scale);
  if (scale == Scale::logarithmic) {
    if (low > high) return {1.0, 10.0};
    const double room = std::max(std::log(1.1), 0.05 * logarithmic_length({low, high}));
    return {grown(low, -room), grown(high, room)};
  }
  if (low > high) return {0.0, 1.0};
  const double spread = high - low;
  if (spread == 0.0) {
    const double room = low == 0.0 ? 1.0 : 0.1 * std::abs(low);
    return {low - room, high + room};
  }
  // Wide enough for tick labels of six digits to differ.
  const double room = std::max(0.05 * spread, 1e-4 * std::max(std::abs(low), std::abs(high)));
  return {low - room, high + room};
}

std::vector<double> ticks(Interval range, int most) {
  const double coarsest = range.high - range.low;
  const double unit = std::pow(10.0, std::floor(std::log10(coarsest / most)));
  std::vector<double> found;
  for (const double factor : {1.0, 2.0, 5.0, 10.0}) {
    const double step = factor * unit;
    const double first = std::ceil(range.low / step), last = std::floor(range.high / step);
    found.clear();
    if (last - first >= most) continue;
    for (int k = 0; k <= static_cast<int>(last - first); ++k)
      found.push_back((first + k) * step + 0.0);  // no -0
    break;
  }
  return found;
}

std::vector<double> logarithmic_ticks(Interval range) {
  const double decades = std::log10(range.high) - std::log10(range.low);
  const auto stride = static_cast<int>(std::ceil(decades / 9.0));
  std::vector<double> found;
  for (auto e = static_cast<int>(std::floor(std::log10(range.low))); e < 400; ++e) {
    const double power = std::pow(10.0, e);
    if (power > range.high) break;
    for (const double factor : {1.0, 2.0, 5.0}) {
      const bool is_wanted = factor == 1.0 ? e % stride == 0 : decades < 3.0;
      if (is_wanted && contains(range, factor * power)) found.push_back(factor * power);
    }
  }
  return found.empty() ? ticks(range, 6) : found;
}

Axis axis_for(std::string label, std::span<const double> values) {
  const Scale scale = scale_for(values);
  return {.label = std::move(label), .range = range_of(values, scale), .scale = scale};
}

Axis with_room_above(Axis axis, double part) {
  auto& [low, high] = axis.range;
  high = axis.scale == Scale::linear ? high + part * (high - low)
                                     : grown(high, part * logarithmic_length(axis.range));
  return axis;
}

double part_of(const Axis& axis, double value) {
  if (axis.scale == Scale::linear)
    return (value - axis.range.low) / (axis.range.high - axis.range.low);
  return logarithmic_length({axis.range.low, value}) / logarithmic_length(axis.range);
}

std::vector<double> ticks_of(const Axis& axis, int most) {
  return axis.scale == Scale::linear ? ticks(axis.range, most) : logarithmic_ticks(axis.range);
}

}  // namespace riesel::io
