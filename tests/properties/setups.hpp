// Random set-ups: systems of all kinds, from a few grains in a large box to crowded corrugated
// tubes, soft and stiff, of every law. A set-up follows from its seed alone.
#pragma once

#include "engine/contact_law.hpp"
#include "engine/state.hpp"
#include "tests/engine/systems.hpp"

#include <cstdint>
#include <string>

namespace properties {

/// Below it a set-up is there to blow up, by all ways in the same manner.
inline constexpr double fewest_steps_per_contact = 8.0;

struct SetUp {
  riesel::State start;
  riesel::ContactModel model;
  std::int64_t steps;  ///< how far to go
  bool equal_masses;
  double steps_per_contact;  ///< in contact_time() of mean grains that meet as fast as they can
};

SetUp random_set_up(std::uint64_t seed);

/// A tube or a shear cell in which contacts are many and some last, for so long that what happens
/// once in a hundred million contact steps does happen. For each law; no step is too long.
SetUp random_flow(std::uint64_t seed);

/// A contact law of any kind, with its friction. Loses energy, or at least wins none.
riesel::ContactModel random_model(systems::Dice& dice);

/// s, the shortest time that steps have to resolve in a head-on contact that begins with `speed`
/// (m/s): how long it lasts, or, where damping is stronger than elasticity, pi times the time in
/// which that alone takes the speed down e-fold.
double contact_time(const riesel::NormalLaw& normal, double reduced_mass, double speed);

/// Makes grains rotate and springs act for every other seed. `shortest`: s, contact_time() of what
/// is to be resolved; before there are grains.
void add_rotation(std::uint64_t seed, double shortest, riesel::ContactModel& model,
                  riesel::State& state);

/// Gravity at an angle for every third seed, smooth walls for every fifth, walls that move for
/// every fourth.
void add_slopes(std::uint64_t seed, riesel::State& state);

/// One line for whoever has to find out what is special about it.
std::string description(const SetUp& set_up);

}  // namespace properties
