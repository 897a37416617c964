// One contact in one step: from the geometry and the motion of two bodies to the force between
// them.
//
// Normal damping and friction need the velocity at the full step, which is not known before the
// force is. The prediction v(n) = w(n-1/2) + a(n-1) dt/2 makes them second order in dt.
//
// Where the damping force jumps, as in eq. (1) when a contact begins and ends at full speed, a
// sampled force would be first order: the kick of a step stands for the time from half a step
// before to half a step after, and the jump falls anywhere. The extrapolated path tells when the
// bodies met and will part; the damping is weighted with the time for which it acts. So the error
// of a contact, averaged over where its ends fall within a step, is second order. What is left:
// where an end falls within a hair of a full step, the extrapolation may take it for before instead
// of after the step (1.5 % of the contacts at t_col/50), and half a step of damping is amiss.
#pragma once

#include "engine/contact_law.hpp"

#include <algorithm>
#include <cmath>

namespace riesel {

/// Two bodies that overlap, seen from the first one. SI units.
struct Encounter {
  double x, y;              ///< m, centre of the second minus centre of the first
  double vx, vy;            ///< m/s, of the second relative to the first, at the full step
  double half_vx, half_vy;  ///< m/s, half a step before
  double reach;             ///< m, sum of the radii; larger than the distance
  double reduced_mass;      ///< kg
};

/// What the contact does in this step.
struct Touch {
  double fx, fy;                  ///< N, on the first body; the second gets the opposite
  double friction_x, friction_y;  ///< N, the part of it that is friction
  double overlap;                 ///< m
  double rate;                    ///< m/s, d(overlap)/dt: positive while approaching
  double slip;   ///< m/s, along s = n turned by 90 degrees, of the first relative to the second
  double since;  ///< s, in touch since; dt if longer than the last step
  double until;  ///< s, in touch for; dt if longer than the next step
  double elastic_energy;  ///< J
  double normal_power;    ///< W, dissipated by the normal damping (negative where a clipped force
                          ///< gives back)
};

/// J, what friction (N, on the first body) took from two bodies in the step before the present one.
/// A step's friction works on the mean of the velocities before and after its kicks, which are
/// those of all contacts of the two bodies: it is known only now.
[[gnu::always_inline]] inline double loss_by_friction(double fx, double fy, const Encounter& e,
                                                      double dt) {
  const double mean_vx = 2.0 * e.half_vx - e.vx, mean_vy = 2.0 * e.half_vy - e.vy;
  return (fx * mean_vx + fy * mean_vy) * dt;
}

/// How much of the last and of the next time step two bodies spend in the overlap: s, at most dt.
struct Passage {
  double since, until;
};

/// The relative path is extrapolated with the present velocity and normal acceleration (m/s^2,
/// positive apart).
[[gnu::always_inline]] inline Passage passage(const Encounter& e, double distance,
                                              double acceleration, double dt) {
  // |r + v s + a s^2 / 2|^2 = reach^2, to second order in s
  const double closing = -(e.x * e.vx + e.y * e.vy);
  const double curvature = e.vx * e.vx + e.vy * e.vy + distance * acceleration;
  const double depth2 = (e.reach - distance) * (e.reach + distance);
  const double root = std::sqrt(closing * closing + curvature * depth2);
  // Written without a quotient that could be 0/0, negative or not a number: then the bodies stay in
  // touch.
  return {depth2 < dt * (root + closing) ? depth2 / (root + closing) : dt,
          depth2 < dt * (root - closing) ? depth2 / (root - closing) : dt};
}

/// The part of the step before (or after) now for which the present kick stands: half of it, unless
/// the contact begins (or ends) in it; then there is no other kick to stand for the rest.
inline double kick_time(double in_touch, double dt) { return in_touch < dt ? in_touch : 0.5 * dt; }

/// Without branches and inlined, so that a loop over contacts can be vectorised.
template <class Normal, class Slip>
[[gnu::always_inline]] inline Touch touch(const Encounter& e, const Normal& normal,
                                          const Slip& slip_law, double mu, Attraction attraction,
                                          double dt) {
  const double distance = std::sqrt(e.x * e.x + e.y * e.y);
  const double per_distance = 1.0 / distance;
  const double nx = e.x * per_distance, ny = e.y * per_distance;

  Touch t;
  t.overlap = e.reach - distance;
  t.rate = -(e.vx * nx + e.vy * ny);
  t.slip = e.vx * ny - e.vy * nx;

  const double elastic = normal.elastic(t.overlap);
  const double damping = normal.damping(t.overlap, t.rate, e.reduced_mass);
  const Passage in_touch = passage(e, distance, (elastic + damping) / e.reduced_mass, dt);
  t.since = in_touch.since;
  t.until = in_touch.until;
  const double weight = (kick_time(t.since, dt) + kick_time(t.until, dt)) / dt;

  double f_n = elastic + weight * damping;
  if (attraction == Attraction::clip) f_n = elastic + damping < 0.0 ? 0.0 : std::max(f_n, 0.0);

  const double half_step_slip = e.half_vx * ny - e.half_vy * nx;
  const double f_s = slip_law.force(mu * std::abs(f_n), t.slip, half_step_slip, e.reduced_mass, dt);

  // n = (nx, ny), s = (-ny, nx)
  t.friction_x = -f_s * ny;
  t.friction_y = f_s * nx;
  t.fx = t.friction_x - f_n * nx;
  t.fy = t.friction_y - f_n * ny;
  t.elastic_energy = normal.stored_energy(t.overlap);
  t.normal_power = (f_n - elastic) * t.rate;
  return t;
}

}  // namespace riesel
