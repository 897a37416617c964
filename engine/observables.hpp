// What can be read off a state at one moment. SI units; but for largest_sum() the same bits for any
// order of the grains.
#pragma once

#include "engine/density_waves.hpp"
#include "engine/state.hpp"

#include <array>
#include <cstdint>
#include <optional>

namespace riesel {

/// The balance of energy; cumulative since step 0 unless a member says "now".
struct Energies {
  double kinetic = 0.0;        ///< J, now, of the motion of the centres
  double rotational = 0.0;     ///< J, now
  double elastic = 0.0;        ///< J, stored in contacts now
  double gravity_work = 0.0;   ///< J, done by gravity
  double wall_work = 0.0;      ///< J, done by walls that move
  double normal_loss = 0.0;    ///< J, dissipated by the normal damping
  double friction_loss = 0.0;  ///< J, dissipated by friction and by resistance to rolling
  double won = 0.0;            ///< J, gained by contacts whose total loss is negative
  double residual = 0.0;       ///< J, origin + work - all the rest: the error of the time step
};

struct Observables {
  double time = 0.0;                      ///< s
  double mean_vx = 0.0, mean_vy = 0.0;    ///< m/s, over grains
  double sigma_vx = 0.0, sigma_vy = 0.0;  ///< m/s, standard deviations over grains
  double granular_temperature = 0.0;      ///< (m/s)^2, (sigma_vx^2 + sigma_vy^2) / 2
  double mean_spin = 0.0;                 ///< rad/s, over grains; 0 where they do not rotate
  double rotational_temperature = 0.0;    ///< (m/s)^2, mean of I w^2 / m
  Energies energies;
  double contacts = 0.0;              ///< present contacts per grain
  double grain_contacts_begun = 0.0;  ///< cumulative count
  double wall_contacts_begun = 0.0;   ///< cumulative count
  double wall_impulse_y = 0.0;        ///< kg m/s, given to the grains by the walls, cumulative
  std::array<double, WallImpulses::most_walls> impulse_y_of_wall{};  ///< its parts: left, right
  std::array<double, WallImpulses::most_walls> impulse_x_of_wall{};  ///< kg m/s, likewise across
  double max_overlap = 0.0;  ///< m, over all contacts so far
  double outside = 0.0;      ///< present grains beyond a wall line: gone through the wall
  std::array<double, density_waves> structure_factor{};  ///< along y, of the longest waves
};

/// What the balances of a run start from, for State::origin; `state` must be at step 0.
Origin origin_of(const State& state);

/// The smallest id of the grains that have gone through a wall (Observables::outside); nothing if
/// there is none.
std::optional<std::int32_t> grain_outside(const State& state);

struct FastestGrain {
  double speed = 0.0;   ///< m/s
  std::int32_t id = 0;  ///< the smallest id of those with this speed
};
FastestGrain fastest_grain(const State& state);

/// The largest absolute value, in SI units, of all sums that grow with the mass: mass, moment and
/// kinetic energy of the grains; elastic energy and (estimated) force times distance of the present
/// contacts; losses, work and impulses so far. A run must stop before it exceeds
/// ExactSum::largest_sum.
double largest_sum(const State& state);

/// m/s, the largest speed that a state of this many grains can represent: faster ones would go
/// round the box within a few steps, or the sums of their squares would exceed the range of
/// ExactSum.
double largest_speed(const Box& box, double time_step, std::size_t grains);

/// All observables of `state`. It takes several passes over all grains.
Observables observe(const State& state);

/// The largest overlap of all contacts since step 0, of those between grains or of those with
/// walls, whichever is larger over the radius of the smallest body of its kind.
struct LargestOverlap {
  double overlap;  ///< m
  double ratio;
  std::optional<Contact> contact;  ///< that had it; none if there never was one
};
LargestOverlap largest_overlap(const State& state);

/// J, the scale of errors of the energy: the energy at the start plus the absolute values of the
/// work of gravity and of that of walls.
double energy_turned_over(double initial, double gravity_work, double wall_work);

/// The error of the energy that the time step has caused, over energy_turned_over(): the absolute
/// value of the residual, plus the energy gained by contacts that should have lost some.
double energy_error_ratio(const State& state, const Energies& energies);

}  // namespace riesel
