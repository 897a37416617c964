// What can be read off a state at one moment. SI units; the same bits for any order of the grains.
#pragma once

#include "engine/density_waves.hpp"
#include "engine/state.hpp"

#include <array>
#include <cstdint>
#include <optional>

namespace riesel {

/// Cumulative since step 0 unless said otherwise.
struct Energies {
  double kinetic = 0.0;        ///< J, now, of the motion of the centres
  double rotational = 0.0;     ///< J, now
  double elastic = 0.0;        ///< J, stored in contacts now
  double gravity_work = 0.0;   ///< J, done by gravity
  double wall_work = 0.0;      ///< J, done by walls that move
  double normal_loss = 0.0;    ///< J, dissipated by the normal damping
  double friction_loss = 0.0;  ///< J, dissipated by friction and by resistance to rolling
  double won = 0.0;            ///< J, by contacts whose losses together are negative
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
  double contacts = 0.0;              ///< per grain, now
  double grain_contacts_begun = 0.0;  ///< cumulative count
  double wall_contacts_begun = 0.0;   ///< cumulative count
  double wall_impulse_y = 0.0;        ///< kg m/s, given to the grains by the walls, cumulative
  std::array<double, WallImpulses::most_walls> impulse_y_of_wall{};  ///< its parts: left, right
  double max_overlap = 0.0;  ///< m, over all contacts so far
  double outside = 0.0;      ///< grains beyond a wall line: gone through the wall, now
  std::array<double, density_waves> structure_factor{};  ///< along y, of the longest waves
};

/// What the balances of a run start from: to be kept in State::origin at step 0.
Origin origin_of(const State& state);

/// The smallest id of a grain that has gone through a wall (Observables::outside).
std::optional<std::int32_t> grain_outside(const State& state);

struct FastestGrain {
  double speed = 0.0;   ///< m/s
  std::int32_t id = 0;  ///< the smallest one of those that are as fast
};
FastestGrain fastest_grain(const State& state);

/// The largest by size of the sums that grow with the mass, in SI units: over the grains of mass,
/// moment and kinetic energy, over the present contacts of their energy and of force times distance
/// (about), and over all so far of losses, work and impulses. To be below ExactSum::largest_sum.
double largest_sum(const State& state);

/// m/s, up to which the state holds what so many grains do: faster ones come around the box within
/// a few steps, or sums of their squares leave the range of ExactSum.
double largest_speed(const Box& box, double time_step, std::size_t grains);

Observables observe(const State& state);

/// The largest overlap of all contacts since step 0, among grains or at walls, as a part of the
/// radius of the smallest body that can have had it.
struct LargestOverlap {
  double overlap;  ///< m
  double ratio;
  std::optional<Contact> contact;  ///< that had it; none if there never was one
};
LargestOverlap largest_overlap(const State& state);

/// J, what errors of the energy are measured by: what the run began with and the sizes of the work
/// of gravity and of that of walls, which are negative where they take energy.
double energy_turned_over(double initial, double gravity_work, double wall_work);

/// How much of the energy of `state` is an error of the time step: the size of the residual, and
/// what contacts have won that should have lost, as a part of the energy turned over.
double energy_error_ratio(const State& state, const Energies& energies);

}  // namespace riesel
