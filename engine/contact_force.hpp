// One contact in one step: from the geometry and the motion of two bodies to the force between
// them.
//
// Normal damping and friction need the velocity at the full step, which itself depends on the
// force. The prediction v(n) = w(n-1/2) + a(n-1) dt/2 makes them second order in dt.
//
// Where the damping force jumps, as in eq. (1) when a contact begins and ends at full speed, a
// sampled force would be first order: the kick of a step stands for the time from half a step
// before to half a step after, and the jump falls anywhere in between. So the path is extrapolated
// to tell when the bodies met and will part, and the damping is weighted with the time for which it
// acts. The error of a contact, averaged over where its ends fall within a step, is then second
// order. One error remains: where an end falls very close to a full step, the extrapolation may put
// it on the wrong side (1.5 % of the contacts at t_col/50), and half a step of damping is wrong.
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

/// The rotation of two bodies in contact, seen from the first one. The contact point divides the
/// line between the centres in the ratio of the radii: so angular momentum is conserved whatever
/// the overlap, as the two torques of a tangential force cancel that of the force pair on the
/// centres.
struct Turning {
  double roll, half_roll;          ///< 1/s, (r_i w_i + r_j w_j) / reach, now and half a step before
  double spin, half_spin;          ///< rad/s, w_i - w_j, likewise
  double inertia;                  ///< moment of inertia of a grain over m r^2
  double part_first, part_second;  ///< radius of each body over the reach
  double per_inertia_first, per_inertia_second;  ///< 1/(kg m^2); 0: a wall grain
  double rolling_arm;                            ///< m, largest rolling torque per normal force
};

/// Stands for Turning where grains do not rotate.
struct NoTurning {};

/// The tangential spring of a contact; zero for laws that have none. It has no default values and
/// is passed by value because GCC 12 would otherwise keep it in memory and vectorise no loop with
/// it.
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
  double since;           ///< s, how long the bodies have touched; dt if longer than the last step
  double until;           ///< s, how long they will touch; dt if longer than the next step
  double elastic_energy;  ///< J
  double normal_power;    ///< W, dissipated by the normal damping; where the force is clipped, the
                          ///< elastic energy that is not given back
  double spring;          ///< m, elongation of the tangential spring; 0 without
  double spring_energy;   ///< J, the part of the elastic energy that is in it
  double torque;          ///< N m, of the friction, on both bodies together: each has its part of
                          ///< the reach
  double rolling_torque;  ///< N m, on the first body; the second gets the opposite
};

/// J, what friction (fx, fy in N, on the first body) took from two bodies in the step before the
/// present one. The work of a step's friction is that on the mean of the velocities before and
/// after the kicks of that step, by all contacts of the two bodies: so it is known only now.
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
  /// s, the time that the present kick stands for: half of the last and half of the next step.
  /// Where the contact begins (or ends) within one of them, all its time in that step, as there is
  /// no other kick to stand for the rest.
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
  // Where these are 0/0, negative or NaN they are not used: then the bodies stay in touch.
  const double since = depth2 / (root + closing), until = depth2 / (root - closing);
  return {.since = begins ? since : dt,
          .until = ends ? until : dt,
          .kick_time = (begins ? since : 0.5 * dt) + (ends ? until : 0.5 * dt)};
}

/// N, the least value that a normal force may have. A bound for either kind of attraction, because
/// GCC 12 does not vectorise a branch between them.
inline double least_force(Attraction attraction) {
  return attraction == Attraction::clip ? 0.0 : -std::numeric_limits<double>::infinity();
}

/// N, positive in repulsion: mean over the step, in which the damping acts for `kick_time` (s). Not
/// below `least`.
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
  // With few contacts the loop is limited by latency, not by throughput. So root and quotient are
  // computed side by side, and factors that do not depend on a late result are combined before it.
  const double distance2 = e.x * e.x + e.y * e.y;
  const double distance = std::sqrt(distance2);
  const double per_distance = distance * (1.0 / distance2);
  const double nx = e.x * per_distance, ny = e.y * per_distance;

  const double overlap = e.reach - distance;
  // 0 - x and x + 0 turn -0 into +0: the sign of a zero would depend on which body is the first.
  const double closing = 0.0 - (e.x * e.vx + e.y * e.vy);
  const double rate = closing * per_distance;
  const double centre_slip = (e.vx * ny - e.vy * nx) + 0.0;
  double slip = centre_slip;
  double half_step_slip = e.half_vx * ny - e.half_vy * nx;
  // The slip since the last step, computed with the distance half-way between the two steps.
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
  const double least = least_force(attraction), per_dt = 1.0 / dt;
  const double pushing = std::max(present, least);
  const Passage in_touch = passage(e, distance, closing, pushing, dt);
  const double f_n = mean_normal_force(elastic, damping, least, in_touch.kick_time, per_dt);

  const Sliding sliding{.limit = mu * std::abs(f_n),
                        .present_limit = mu * std::abs(pushing),
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
