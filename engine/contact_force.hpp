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
#include <limits>
#include <type_traits>

namespace riesel {

/// Two bodies that overlap, seen from the first one. SI units.
struct Encounter {
  double x, y;              ///< m, centre of the second minus centre of the first
  double vx, vy;            ///< m/s, of the second relative to the first, at the full step
  double half_vx, half_vy;  ///< m/s, half a step before
  double reach;             ///< m, sum of the radii; larger than the distance
  double reduced_mass;      ///< kg
  double per_reduced_mass;  ///< 1/kg
};

/// The turning of two bodies in contact, seen from the first one. The surfaces meet on the line of
/// centres, which the contact point divides as the radii do: so the two torques of a tangential
/// force and that of the force pair on the orbit add up to zero, whatever the overlap.
struct Turning {
  double roll, half_roll;  ///< 1/s, (r_i w_i + r_j w_j) / reach, at the full step and before
  double spin, half_spin;  ///< rad/s, w_i - w_j, likewise
  double inertia;          ///< moment of inertia of a grain over m r^2
  double part_first, part_second;                ///< of the reach, which is each body's radius
  double per_inertia_first, per_inertia_second;  ///< 1/(kg m^2); 0: a wall grain
  double rolling_arm;                            ///< m, largest rolling torque per normal force
};

/// Of grains that do not rotate.
struct NoTurning {};

/// The tangential spring of a contact; zero for laws that have none. Without default values, and
/// handed on by value: else GCC 12 keeps it in memory, and no loop with it is vectorised.
struct Stretch {
  double spring;  ///< m, its elongation a step before
  double time;    ///< s, for which the slip has stretched it since
};

/// What the contact does in this step.
struct Touch {
  double fx, fy;                  ///< N, on the first body; the second gets the opposite
  double friction_x, friction_y;  ///< N, the part of it that is friction
  double overlap;                 ///< m
  double rate;                    ///< m/s, d(overlap)/dt: positive while approaching
  double slip;  ///< m/s, of the surfaces, of the first relative to the second, along s = n turned
                ///< by 90 degrees
  double centre_slip;     ///< m/s, that of the centres alone
  double since;           ///< s, in touch since; dt if longer than the last step
  double until;           ///< s, in touch for; dt if longer than the next step
  double elastic_energy;  ///< J
  double normal_power;    ///< W, dissipated by the normal damping (negative where a clipped force
                          ///< gives back)
  double spring;          ///< m, elongation of the tangential spring; 0 without
  double spring_energy;   ///< J, the part of the elastic energy that is in it
  double torque;          ///< N m, of the friction, on both bodies together: each has its part of
                          ///< the reach
  double rolling_torque;  ///< N m, on the first body; the second gets the opposite
};

/// J, what friction (N, on the first body) took from two bodies in the step before the present one.
/// A step's friction works on the mean of the velocities before and after its kicks, which are
/// those of all contacts of the two bodies: it is known only now.
[[gnu::always_inline]] inline double loss_by_friction(double fx, double fy, const Encounter& e,
                                                      double dt) {
  const double mean_vx = 2.0 * e.half_vx - e.vx, mean_vy = 2.0 * e.half_vy - e.vy;
  return (fx * mean_vx + fy * mean_vy) * dt;
}

/// J, the same for the torques (N m, as in Touch) that friction and rolling resistance exerted.
[[gnu::always_inline]] inline double loss_by_torques(double torque, double rolling_torque,
                                                     const Turning& t, double dt) {
  const double mean_roll = 2.0 * t.half_roll - t.roll, mean_spin = 2.0 * t.half_spin - t.spin;
  return -(torque * mean_roll + rolling_torque * mean_spin) * dt;
}

/// How much of the last and of the next time step two bodies spend in the overlap.
struct Passage {
  double since, until;  ///< s, at most dt
  /// s, for which the present kick stands: half of each of the two steps, unless the contact begins
  /// (or ends) in it; then there is no other kick to stand for the rest.
  double kick_time;
};

/// The relative path is extrapolated with the present velocity and force (N, positive apart).
/// `closing` is -r v, m^2/s.
[[gnu::always_inline]] inline Passage passage(const Encounter& e, double distance, double closing,
                                              double force, double dt) {
  // |r + v s + a s^2 / 2|^2 = reach^2, to second order in s
  const double depth2 = (e.reach - distance) * (e.reach + distance);
  const double straight = closing * closing + (e.vx * e.vx + e.vy * e.vy) * depth2;
  const double root = std::sqrt(straight + (distance * e.per_reduced_mass * depth2) * force);
  const bool begins = depth2 < dt * (root + closing), ends = depth2 < dt * (root - closing);
  // What could be 0/0, negative or not a number is not taken: then the bodies stay in touch.
  const double since = depth2 / (root + closing), until = depth2 / (root - closing);
  return {.since = begins ? since : dt,
          .until = ends ? until : dt,
          .kick_time = (begins ? since : 0.5 * dt) + (ends ? until : 0.5 * dt)};
}

/// N, the least that a normal force may be: a bound for both kinds of attraction, as GCC 12 does
/// not vectorise a branch.
inline double least_force(Attraction attraction) {
  return attraction == Attraction::clip ? 0.0 : -std::numeric_limits<double>::infinity();
}

/// N, positive where it pushes: the mean over the step, in which the damping acts for `kick_time`.
[[gnu::always_inline]] inline double mean_normal_force(double elastic, double damping, double least,
                                                       double kick_time, double per_dt) {
  const bool pulls = elastic + damping < least;
  const double pushing = pulls ? 0.0 : elastic, slowing = pulls ? 0.0 : damping * per_dt;
  return std::max(pushing + kick_time * slowing, least);
}

/// kg, what opposes a change of the slip: a tangential force moves the centres, and turns grains
/// that rotate.
[[gnu::always_inline]] inline double slip_mass(const Encounter& e, double distance,
                                               const Turning& t) {
  const double arm = distance / e.reach;
  return e.reduced_mass / (1.0 + arm * arm / t.inertia);
}
[[gnu::always_inline]] inline double slip_mass(const Encounter& e, double, const NoTurning&) {
  return e.reduced_mass;
}

/// N m, on the first body: model A of Ai, Chen, Rotter and Ooi, Powder Technology 206, 269 (2011),
/// mu_r R |F_N| against the relative spin, R = r_i r_j / (r_i + r_j); but, as CappedSlip, never
/// more than what stops it within the step.
[[gnu::always_inline]] inline double rolling_resistance(const Turning& t, double f_n, double dt) {
  const double stops = t.half_spin / ((t.per_inertia_first + t.per_inertia_second) * dt);
  return 0.0 - capped(t.rolling_arm * std::abs(f_n), stops);
}

/// Without branches and inlined, so that a loop over contacts can be vectorised. `Turn` is Turning
/// or NoTurning.
template <class Turn, class Normal, class Slip>
[[gnu::always_inline]] inline Touch touch(const Encounter& e, const Turn& turn, Stretch stretch,
                                          const Normal& normal, const Slip& slip_law, double mu,
                                          Attraction attraction, double dt) {
  constexpr bool turns = std::is_same_v<Turn, Turning>;
  // Contacts that are few wait for each other's results, not for units that compute: root and
  // quotient side by side, and what does not depend on a late result put together before it.
  const double distance2 = e.x * e.x + e.y * e.y;
  const double distance = std::sqrt(distance2);
  const double per_distance = distance * (1.0 / distance2);
  const double nx = e.x * per_distance, ny = e.y * per_distance;

  const double overlap = e.reach - distance;
  // What is nothing has no sign, or it would be that of whoever is first: hence 0 - x and x + 0.
  const double closing = 0.0 - (e.x * e.vx + e.y * e.vy);
  const double rate = closing * per_distance;
  const double centre_slip = (e.vx * ny - e.vy * nx) + 0.0;
  double slip = centre_slip;
  double half_step_slip = e.half_vx * ny - e.half_vy * nx;
  // The way slipped since the last step, with the distance that the bodies had on the way.
  const double on_the_way = distance - 0.5 * dt * (e.half_vx * nx + e.half_vy * ny);
  double slipping = half_step_slip * (distance / on_the_way);
  if constexpr (turns) {
    slip += distance * turn.roll;
    half_step_slip += distance * turn.half_roll;
    slipping += on_the_way * turn.half_roll;
  }

  const double elastic = normal.elastic(overlap);
  const double damping = normal.damping(overlap, rate, e.reduced_mass);
  const double present = elastic + damping;
  const Passage in_touch = passage(e, distance, closing, present, dt);
  const double least = least_force(attraction), per_dt = 1.0 / dt;
  const double f_n = mean_normal_force(elastic, damping, least, in_touch.kick_time, per_dt);

  const Sliding sliding{.limit = mu * std::abs(f_n),
                        .present_limit = mu * std::abs(std::max(present, least)),
                        .slip = slip,
                        .half_step_slip = half_step_slip,
                        .spring = stretch.spring + slipping * stretch.time,
                        .weight = in_touch.kick_time * per_dt,
                        .reduced_mass = e.reduced_mass,
                        .slip_mass = slip_mass(e, distance, turn),
                        .per_dt = per_dt};
  const double f_s = slip_law.force(sliding);
  // n = (nx, ny), s = (-ny, nx)
  const double friction_x = 0.0 - f_s * ny, friction_y = f_s * nx + 0.0;

  double spring = 0.0, spring_energy = 0.0, torque = 0.0, rolling_torque = 0.0;
  if constexpr (Slip::has_spring) {
    spring = slip_law.elongation(sliding);
    spring_energy = slip_law.stored_energy(spring);
  }
  if constexpr (turns) {
    torque = distance * f_s + 0.0;
    rolling_torque = rolling_resistance(turn, f_n, dt) + 0.0;
  }
  return {.fx = friction_x - f_n * nx,
          .fy = friction_y - f_n * ny,
          .friction_x = friction_x,
          .friction_y = friction_y,
          .overlap = overlap,
          .rate = rate,
          .slip = slip,
          .centre_slip = centre_slip,
          .since = in_touch.since,
          .until = in_touch.until,
          .elastic_energy = normal.stored_energy(overlap) + spring_energy,
          .normal_power = (f_n - elastic) * rate,
          .spring = spring,
          .spring_energy = spring_energy,
          .torque = torque,
          .rolling_torque = rolling_torque};
}

}  // namespace riesel
