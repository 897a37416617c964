// From the integers of the state to an encounter of two bodies in SI units.
#pragma once

#include "engine/contact_force.hpp"
#include "engine/state.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace riesel {

/// Position and motion of a body at a step, in quanta: `u` is the displacement in that step. Half
/// of `kick` takes it to the velocity at the step itself: of grains it is the kick of the step
/// before, which `u` has already, of walls what `u` will be larger by in the next step. In a State
/// between two advances it is the latter for grains, too.
struct BodyMotion {
  FixedVector position, u, kick;
};

/// The numbers that the work on a step needs: factors between quanta and SI units, the time, and
/// the motion of the walls.
struct StepUnits {
  explicit StepUnits(const State& state)
      : box(state.box),
        dt(state.time_step),
        fall(fall_per_step(state)),
        metre_x(state.box.quantum_x()),
        metre_y(state.box.quantum_y()),
        velocity_x(metre_x / dt),
        velocity_y(metre_y / dt),
        kick_x(dt * dt / metre_x),
        kick_y(dt * dt / metre_y),
        spin(quantum_of_angle / dt),
        spin_kick(dt * dt / quantum_of_angle) {
    for (std::size_t wall = 0; wall < state.walls.size(); ++wall) {
      motion[wall] = state.walls[wall].motion;
      walls_move = walls_move || motion[wall].is_ever_away();
    }
    move_to(state.step);
  }

  void move_to(std::int64_t new_step) {
    step = static_cast<double>(new_step);
    time = step * dt;
    fallen = wrapped_product(new_step, fall);
    if (walls_move) move_walls_to(new_step);
  }

  Box box;
  double dt;                      ///< s
  FixedVector fall;               ///< quanta per step^2
  double metre_x, metre_y;        ///< m per quantum
  double velocity_x, velocity_y;  ///< m/s per quantum per step
  double kick_x, kick_y;          ///< quanta per step^2 over m/s^2
  double spin;                    ///< rad/s per quantum of angle per step
  double spin_kick;               ///< quanta per step^2 over rad/s^2

  double step;         ///< number of the step, exact up to 2^53
  double time;         ///< s
  FixedVector fallen;  ///< quanta per step, velocity of the falling frame in this step

  bool walls_move = false;
  std::array<WallMotion, WallImpulses::most_walls> motion{};
  std::array<BodyMotion, WallImpulses::most_walls> walls{};  ///< from where they were at first

private:
  void move_walls_to(std::int64_t n) {
    for (std::size_t wall = 0; wall < walls.size(); ++wall) {
      const auto shift = [&](std::int64_t at) { return motion[wall].shift(box, dt, at); };
      const FixedVector now = shift(n), u = wrapped_difference(now, shift(n - 1));
      walls[wall] = {.position = now,
                     .u = u,
                     .kick = wrapped_difference(wrapped_difference(shift(n + 1), now), u)};
    }
  }
};

/// The motion of bodies, in arrays as those of Grains. The index of a body in them is its place:
/// the slot in the store, or the place in DeflectedGrains.
struct Bodies {
  const FixedVector *position, *u, *kick;
  const Fixed *spin, *spin_kick;  ///< null where they do not rotate
  double inertia;

  bool rotate() const { return inertia > 0.0; }
};

/// What the contacts of a step add to the displacement per step (quanta) and to the angle per step
/// (quanta of angle) of a body.
struct BodyKick {
  FixedVector by;
  Fixed spin;
};

inline Bodies bodies(const Grains& g) {
  return {.position = g.position.data(),
          .u = g.u.data(),
          .kick = g.kick.data(),
          .spin = g.spin.data(),
          .spin_kick = g.spin_kick.data(),
          .inertia = g.inertia};
}

/// The motion of body j relative to body i.
[[gnu::always_inline]] inline BodyMotion relative_motion(const Bodies& b, std::int64_t i,
                                                         std::int64_t j) {
  return {.position = wrapped_difference(b.position[j], b.position[i]),
          .u = wrapped_difference(b.u[j], b.u[i]),
          .kick = wrapped_difference(b.kick[j], b.kick[i])};
}

/// The motion of a wall grain relative to body i. The wall is not in the falling frame.
[[gnu::always_inline]] inline BodyMotion
relative_motion(const Bodies& b, std::int64_t i, const BodyMotion& wall, const StepUnits& units) {
  return {.position = wrapped_difference(wall.position, b.position[i]),
          .u = wrapped_difference(wall.u, wrapped_sum(b.u[i], units.fallen)),
          .kick = wrapped_difference(wall.kick, wrapped_sum(b.kick[i], units.fall))};
}

/// The constants of two bodies that their relative motion depends on.
struct ReducedPair {
  double reach;     ///< m, sum of the radii
  double mass;      ///< kg, the reduced mass
  double per_mass;  ///< 1/kg
};

/// Converts a relative motion to SI units. Half of the kick of the step before takes the velocity
/// from the half step to the full one.
template <class Numbers = ByConversion>
[[gnu::always_inline]] inline Encounter encounter(const BodyMotion& m, const ReducedPair& pair,
                                                  const StepUnits& units) {
  const double half_vx = Numbers::real(m.u.x) * units.velocity_x;
  const double half_vy = Numbers::real(m.u.y) * units.velocity_y;
  return {.x = Numbers::real(m.position.x) * units.metre_x,
          .y = Numbers::real(m.position.y) * units.metre_y,
          .vx = half_vx + Numbers::real(m.kick.x) * (0.5 * units.velocity_x),
          .vy = half_vy + Numbers::real(m.kick.y) * (0.5 * units.velocity_y),
          .half_vx = half_vx,
          .half_vy = half_vy,
          .reach = pair.reach,
          .reduced_mass = pair.mass,
          .per_reduced_mass = pair.per_mass};
}

/// The spin of a body in rad/s, at the full step and half a step before.
struct Spin {
  double now = 0.0, half = 0.0;  // zero: a wall grain
};

template <class Numbers = ByConversion>
[[gnu::always_inline]] inline Spin spin_of(const Bodies& b, std::int64_t i,
                                           const StepUnits& units) {
  const double half = Numbers::real(b.spin[i]) * units.spin;
  return {half + 0.5 * (Numbers::real(b.spin_kick[i]) * units.spin), half};
}

/// The constants of two bodies that their rotation depends on.
struct BodyPair {
  double radius_first, radius_second;      ///< m; 0 for the second: a smooth wall
  double per_mass_first, per_mass_second;  ///< 1/kg; 0: a wall grain
};

/// `inertia` is the moment of inertia over m r^2. Exchanging the bodies changes no bit but the
/// signs of `spin` and `half_spin`, and swaps the members named first and second.
[[gnu::always_inline]] inline Turning turning(const BodyPair& b, const Spin& first,
                                              const Spin& second, double inertia,
                                              double rolling_friction) {
  const double reach = b.radius_first + b.radius_second;
  // A plane has no radius and does not turn: the contact rolls with the radius of the first body.
  // The radius put for the second only avoids a division by zero.
  const bool plane = b.radius_second == 0.0;
  const double radius_second = plane ? b.radius_first : b.radius_second;
  const double rolling_radius = plane ? b.radius_first : b.radius_first * b.radius_second / reach;
  const double part_first = b.radius_first / reach, part_second = b.radius_second / reach;
  return {.roll = part_first * first.now + part_second * second.now,
          .half_roll = part_first * first.half + part_second * second.half,
          .spin = first.now - second.now,
          .half_spin = first.half - second.half,
          .inertia = inertia,
          .part_first = part_first,
          .part_second = part_second,
          .per_inertia_first = b.per_mass_first / (inertia * (b.radius_first * b.radius_first)),
          .per_inertia_second = b.per_mass_second / (inertia * (radius_second * radius_second)),
          .rolling_arm = rolling_friction * rolling_radius};
}

/// m^2
[[gnu::always_inline]] inline double squared_length(const FixedVector& v, const StepUnits& units) {
  const double dx = real(v.x) * units.metre_x;
  const double dy = real(v.y) * units.metre_y;
  return dx * dx + dy * dy;
}

/// Whether two bodies touch whose centres are `apart` (quanta), with the sum of radii `reach` (m).
/// The one test that decides about the beginning of a contact; the contact kernel ends it by the
/// same formula.
[[gnu::always_inline]] inline bool overlapping(const FixedVector& apart, double reach,
                                               const StepUnits& units) {
  return squared_length(apart, units) < reach * reach;
}

}  // namespace riesel
