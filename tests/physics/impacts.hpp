// Impacts on the wall as the paper's figures have them.
#pragma once

#include "engine/closed_forms.hpp"
#include "engine/impact.hpp"
#include "tests/engine/systems.hpp"

#include <algorithm>
#include <cmath>

namespace impacts {

using namespace systems;

inline constexpr double reach = radius + wall_radius;  // m
inline constexpr double impact_height = 0.82e-3;       // m
inline constexpr double spacing = 0.66e-3;             // m, touching wall grains

/// s, of a grain on the wall, with the paper's numbers
inline double wall_collision_time() {
  return LinearContact{stiffness, damping, mass}.collision_time();
}

inline ImpactSetup single_wall_grain(const ContactModel& model, double collision_time) {
  return {.grain_radius = radius,
          .grain_mass = mass,
          .wall_grain_radius = wall_radius,
          .wall_spacing = 0.0,
          .model = model,
          .collision_time = collision_time};
}

inline ImpactSetup wall_array(const ContactModel& model, double collision_time) {
  ImpactSetup setup = single_wall_grain(model, collision_time);
  setup.wall_spacing = spacing;
  return setup;
}

/// s, a time step that resolves both the contact and the passage of the chord.
inline double resolving_time_step(double collision_time, double height, double v_y, double steps) {
  return std::min(collision_time, chord(reach, height) / v_y) / steps;
}

/// Scenario 1 at one velocity.
inline ImpactResult pass(const ImpactSetup& setup, double v_y, double steps) {
  return follow(
      setup, {.x = impact_height,
              .y = just_upstream(setup, impact_height),
              .v_x = 0.0,
              .v_y = v_y,
              .time_step = resolving_time_step(setup.collision_time, impact_height, v_y, steps)});
}

}  // namespace impacts
