// What an impact of two rigid discs that do not turn does to them: the limit of the linear contact
// whose stiffness grows while its restitution stays.
//
// In that limit the bodies do not move while they touch, so that nothing but the impulses counts.
// The overlap is a damped oscillation, xi'' = -F_N / m_red. The normal impulse is what reverses the
// approach, (1 + e_N) of it. Friction is mu |F_N| against the slip until the slip has stopped; as
// the end of a contact may pull, the integral of |F_N| is more than the normal impulse.
#pragma once

#include "engine/closed_forms.hpp"

#include <algorithm>
#include <cmath>

namespace riesel::bench {

/// Per speed of approach and reduced mass.
struct ImpactRule {
  double restitution;  ///< e_N
  double grip;         ///< mu times the integral of |F_N|: what friction can take at most
};

/// Of a contact that rebounds.
inline ImpactRule rigid_limit(const LinearContact& contact, double mu) {
  LinearContact pushed = contact;
  pushed.attraction = Attraction::clip;
  const double fastest = pushed.restitution();  // where F_N vanishes
  if (contact.attraction == Attraction::clip)
    return {.restitution = fastest, .grip = mu * (1.0 + fastest)};
  const double last = contact.restitution();
  return {.restitution = last, .grip = mu * (1.0 - last + 2.0 * fastest)};
}

/// kg m/s, what an impact gives to the first body; the second gets the opposite.
struct Impulse {
  double x, y;
};

/// (nx, ny) points from the first body to the second, (vx, vy) in m/s is the velocity of the second
/// relative to the first, the reduced mass in kg. They approach.
inline Impulse impulse_of(const ImpactRule& rule, double reduced_mass, double nx, double ny,
                          double vx, double vy) {
  const double approach = std::max(0.0, -(vx * nx + vy * ny));  // or less by rounding
  const double slip = vy * nx - vx * ny;                        // along s = (-ny, nx)
  const double most = rule.grip * approach;
  const double normal = -(1.0 + rule.restitution) * approach;
  const double tangential = std::max(-most, std::min(most, slip));
  return {.x = reduced_mass * (normal * nx - tangential * ny),
          .y = reduced_mass * (normal * ny + tangential * nx)};
}

}  // namespace riesel::bench
