// Isolated collisions, run by the engine to their end.
#pragma once

#include "engine/closed_forms.hpp"
#include "engine/simulation.hpp"
#include "tests/engine/systems.hpp"

#include <Eigen/Core>

#include <stdexcept>

namespace collisions {

using namespace systems;
using Eigen::Vector2d;

/// What is left of a collision.
struct Outcome {
  Vector2d velocity;         ///< m/s, of the first grain
  Vector2d second_velocity;  ///< m/s, of the second; zero if that is a wall grain
  double spin, second_spin;  ///< rad/s, likewise
  ContactTally tally;

  double contact_time() const { return tally.duration.value(); }
  double losses() const { return tally.normal_loss.value() + tally.friction_loss.value(); }
};

/// A box so large that it does not matter, with a time step.
inline State open_space(double dt) {
  State state = empty_box(40e-3, 40e-3);
  state.time_step = dt;
  return state;
}

/// Runs until the first contact is over.
inline Outcome collide(const State& start, const ContactModel& model) {
  constexpr int patience = 1'000'000;  // steps
  Simulation simulation(start, model, 1);
  const bool at_wall = !start.walls.empty();
  const auto tally = [&]() -> const ContactTally& {
    const Tally& all = simulation.state().tally;
    return at_wall ? all.walls : all.grains;
  };
  while (tally().ended == 0) {
    if (simulation.state().step > patience) throw std::runtime_error("the collision does not end");
    simulation.advance(1);
  }
  simulation.advance(1);  // the velocity at the full step is free of the contact's last kick
  const auto of = [&](std::int32_t id) { return grain_of_id(simulation.state(), id); };
  const auto velocity = [](const Grain& g) { return Vector2d(g.vx, g.vy); };
  return {.velocity = velocity(of(0)),
          .second_velocity = at_wall ? Vector2d(0.0, 0.0) : velocity(of(1)),
          .spin = of(0).spin,
          .second_spin = at_wall ? 0.0 : of(1).spin,
          .tally = tally()};
}

constexpr double flat_radius = 10.0;  // m: so large that the normal does not turn in a contact

/// A grain about to hit a flat wall at x = 0 with the velocity (-normal, along).
inline State above_flat_wall(double normal, double along, double dt, double inertia = 0.0,
                             double spin = 0.0) {
  State state = empty_box(100.0, 100.0);
  state.time_step = dt;
  state.grains.inertia = inertia;
  state.walls = {{.line = -flat_radius, .radius = flat_radius, .count = 1}};
  Grain g = grain(radius + 2.5 * normal * dt, 0.0, -normal, along);
  g.spin = spin;
  add_grain(state, g);
  return state;
}

/// A grain that meets one wall grain standing at the origin.
inline Outcome hit_wall_grain(const Grain& grain, double radius_of_wall, const ContactModel& model,
                              double dt) {
  State state = open_space(dt);
  state.walls = {{.line = 0.0, .radius = radius_of_wall, .count = 1}};
  add_grain(state, grain);
  return collide(state, model);
}

/// Two grains, or a grain and the wall, that meet head-on.
struct HeadOn {
  double mass_1, mass_2;  ///< kg; an infinite mass_2 stands for a wall grain
  double speed;           ///< m/s, of approach
  double dt;              ///< s
  double phase = 0.0;     ///< part of a time step from a full step to the first touch

  double reduced_mass() const {
    return std::isinf(mass_2) ? mass_1 : mass_1 * mass_2 / (mass_1 + mass_2);
  }
};

struct Rebound {
  double restitution;
  double contact_time;  ///< s
  double max_overlap;   ///< m
};

inline Rebound head_on(const HeadOn& h, const ContactModel& model) {
  const double gap = (2.0 + h.phase) * h.speed * h.dt;
  State state = open_space(h.dt);
  if (std::isinf(h.mass_2)) {
    state.walls = {{.line = 0.0, .radius = wall_radius, .count = 1}};
    add_grain(state, {.x = radius + wall_radius + gap,
                      .y = 0.0,
                      .vx = -h.speed,
                      .vy = 0.0,
                      .radius = radius,
                      .mass = h.mass_1});
    const Outcome out = collide(state, model);
    return {out.velocity.x() / h.speed, out.contact_time(), out.tally.max_overlap};
  }
  // In the frame of the centre of mass of neither grain, nor along an axis.
  const Vector2d along(0.8, 0.6), common(0.3, -0.2);
  const Vector2d centre(5e-3, 1e-3), second = centre + (2.0 * radius + gap) * along;
  const Vector2d v = common + h.speed * along;
  add_grain(state, {centre.x(), centre.y(), v.x(), v.y(), radius, h.mass_1});
  add_grain(state, {second.x(), second.y(), common.x(), common.y(), radius, h.mass_2});
  const Outcome out = collide(state, model);
  return {(out.second_velocity - out.velocity).dot(along) / h.speed, out.contact_time(),
          out.tally.max_overlap};
}

/// s, a 50th of a head-on contact with a wall.
inline double step_of(double gamma) {
  return LinearContact{stiffness, gamma, mass}.collision_time() / 50.0;
}

}  // namespace collisions
