// Random set-ups: systems of all kinds, from a few grains in a large box to crowded corrugated
// tubes, soft and stiff, of every law. A set-up follows from its seed alone.
#pragma once

#include "engine/contact_law.hpp"
#include "engine/state.hpp"
#include "tests/engine/systems.hpp"

#include <cstdint>
#include <string>

namespace properties {

struct SetUp {
  riesel::State start;
  riesel::ContactModel model;
  std::int64_t steps;  ///< how far to go
  bool equal_masses;
  double steps_per_collision;  ///< of two mean grains that meet with the typical speed
};

SetUp random_set_up(std::uint64_t seed);

/// A contact law of any kind, with its friction. Loses energy, or at least wins none.
riesel::ContactModel random_model(systems::Dice& dice);

/// Makes grains rotate and springs act for every other seed. `t_col` in s; before there are grains.
void add_rotation(std::uint64_t seed, double t_col, riesel::ContactModel& model,
                  riesel::State& state);

/// Gravity at an angle for every third seed, smooth walls for every fifth, walls that move for
/// every fourth.
void add_slopes(std::uint64_t seed, riesel::State& state);

/// One line for whoever has to find out what is special about it.
std::string description(const SetUp& set_up);

}  // namespace properties
