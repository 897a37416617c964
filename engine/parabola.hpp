// How long a body takes to cover a distance at constant acceleration.
#pragma once

#include <cmath>
#include <limits>

namespace riesel {

/// Steps that a body of velocity `u` (m per step) and acceleration `a` (m per step^2) takes to
/// cover `gap` > 0 (m); infinite if it turns back before. A body that moves by v s + a s (s + 1) /
/// 2 in s whole steps has u = v + a / 2.
inline double steps_to_go(double gap, double u, double a) {
  constexpr double forever = std::numeric_limits<double>::infinity();
  const double root2 = u * u + 2.0 * a * gap;
  if (root2 < 0.0) return forever;
  if (u < 0.0 && a > 0.0) return (std::sqrt(root2) - u) / a;  // u + sqrt(root2) would cancel
  const double closing = u + std::sqrt(root2);
  return closing > 0.0 ? 2.0 * gap / closing : forever;
}

}  // namespace riesel
