// The space in which the grains live: periodic along y, bounded by walls (or nothing) along x.
#pragma once

#include "engine/fixed_point.hpp"

#include <cmath>

namespace riesel {

/// Periodic along y with period `length`. x is representable in [-4 width, 4 width); grains belong
/// between the walls at 0 and `width`, and one beyond [-width, 2 width] counts as lost, so that
/// differences of two x never overflow.
struct Box {
  double width;  ///< m, distance between the wall lines (or the scale of x where there is one wall)
  double length;  ///< m, period along y

  double quantum_x() const { return 8.0 * width * two_to_minus_64; }  ///< m
  double quantum_y() const { return length * two_to_minus_64; }       ///< m

  /// Converts x in m to quanta; |x| < 4 width is not checked.
  Fixed fixed_x(double x) const { return nearest_fixed(x / quantum_x()); }

  /// Converts y in m, in any period, to quanta.
  Fixed fixed_y(double y) const {
    const double fraction = y / length - std::nearbyint(y / length);  // in [-1/2, 1/2]
    return fraction >= 0.5 ? INT64_MIN : nearest_fixed(fraction / two_to_minus_64);
  }

  double metres_x(Fixed x) const { return static_cast<double>(x) * quantum_x(); }

  /// y in m in [-length/2, length/2): for differences between two grains (nearest image).
  double metres_y(Fixed y) const { return static_cast<double>(y) * quantum_y(); }

  /// Maps y in m, in any period, to [0, length).
  double wrapped(double y) const { return below_period(y - length * std::floor(y / length)); }

  /// y in m in [0, length): for the place of a grain.
  double place_y(Fixed y) const {
    return below_period(static_cast<double>(static_cast<std::uint64_t>(y)) * quantum_y());
  }

private:
  /// A y just below the period may have been rounded up to it: that is y = 0.
  double below_period(double y) const { return y < length ? y : 0.0; }
};

}  // namespace riesel
