// One contact in one step: from the geometry and the motion of two bodies to the force between them.
//
// Normal damping and friction need the velocity at the full step, which is not known before the force is.
// The prediction v(n) = w(n-1/2) + a(n-1) dt/2 makes them second order in dt.
//
// Where the damping force jumps, as in eq. (1) when a contact begins and ends at full speed, a sampled force
// would be first order: the kick of a step stands for the time from half a step before to half a step after,
// and the jump falls anywhere. The straight relative path tells when the bodies met and will part, to second
// order; the damping is weighted with the part of the kick's time that it covers.
#pragma once

#include "engine/contact_law.hpp"

#include <Eigen/Core>

#include <cmath>

namespace riesel {

/// Two bodies that overlap, seen from the first one. SI units.
struct Encounter {
  Eigen::Vector2d separation;          ///< m, centre of the second minus centre of the first
  Eigen::Vector2d velocity;            ///< m/s, of the second relative to the first, at the full step
  Eigen::Vector2d half_step_velocity;  ///< m/s, half a step before
  double reach;                        ///< m, sum of the radii; |separation| < reach
  double reduced_mass;                 ///< kg
};

/// What the contact does in this step.
struct Touch {
  Eigen::Vector2d force;  ///< N, on the first body; the second gets the opposite
  double overlap;         ///< m
  double rate;            ///< m/s, d(overlap)/dt: positive while approaching
  double slip;            ///< m/s, along s = n turned by 90 degrees, of the first relative to the second
  double since;           ///< s, the straight path entered the overlap so long ago
  double until;           ///< s, and leaves it after this time
  double elastic_energy;  ///< J
  double normal_power;    ///< W, dissipated by the normal damping (negative where a clipped force gives back)
  double friction_power;  ///< W, dissipated by friction
};

/// The time before and after now that the straight relative path spends in the overlap. s; infinite at rest.
struct Passage {
  double since, until;
};

inline Passage straight_passage(const Encounter& e) {
  const double closing = -e.separation.dot(e.velocity);
  const double speed2 = e.velocity.squaredNorm();
  const double depth2 = e.reach * e.reach - e.separation.squaredNorm();
  const double half_chord = std::sqrt(closing * closing + speed2 * depth2);
  return {(half_chord - closing) / speed2, (half_chord + closing) / speed2};
}

template <class Normal, class Slip>
Touch touch(const Encounter& e, const Normal& normal, const Slip& slip_law, double mu,
            Attraction attraction, double dt) {
  const double distance = e.separation.norm();
  const Eigen::Vector2d n = e.separation / distance;
  const Eigen::Vector2d s(-n.y(), n.x());

  Touch t;
  t.overlap = e.reach - distance;
  t.rate = -e.velocity.dot(n);
  t.slip = -e.velocity.dot(s);

  // `since` runs backwards along the path, so closing counts against it.
  const Passage passage = straight_passage(e);
  t.since = passage.since;
  t.until = passage.until;
  const double covered_before = t.since < dt ? t.since : 0.5 * dt;
  const double covered_after = t.until < dt ? t.until : 0.5 * dt;
  const double weight = (covered_before + covered_after) / dt;

  const double elastic = normal.elastic(t.overlap);
  const double damping = normal.damping(t.overlap, t.rate, e.reduced_mass);
  double f_n = elastic + weight * damping;
  if (attraction == Attraction::clip && (elastic + damping < 0.0 || f_n < 0.0)) f_n = 0.0;

  const double half_step_slip = -e.half_step_velocity.dot(s);
  const double f_s = slip_law.force(mu * std::abs(f_n), t.slip, half_step_slip, e.reduced_mass, dt);

  t.force = f_s * s - f_n * n;
  t.elastic_energy = normal.stored_energy(t.overlap);
  t.normal_power = (f_n - elastic) * t.rate;
  t.friction_power = -f_s * t.slip;
  return t;
}

}  // namespace riesel
