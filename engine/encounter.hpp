// From the integers of the state to an encounter of two bodies in SI units.
#pragma once

#include "engine/contact_force.hpp"
#include "engine/state.hpp"

#include <Eigen/Core>

#include <cstdint>

namespace riesel {

/// The numbers of the current step that turn quanta into SI units and back.
class StepUnits {
public:
  explicit StepUnits(const State& state)
      : dt(state.time_step),
        time(state.time()),
        step(static_cast<double>(state.step)),
        fall_(fall_per_step(state)),
        fallen_(wrapped_product(fall_, state.step)),
        metres_(state.box.quantum_x(), state.box.quantum_y()),
        velocity_(metres_ / dt),
        kick_(dt * dt / metres_.array()) {}

  const double dt, time, step;

  Eigen::Vector2d metres(Fixed x, Fixed y) const { return scaled(x, y, metres_); }
  /// m/s, from displacements per step
  Eigen::Vector2d velocity(Fixed ux, Fixed uy) const { return scaled(ux, uy, velocity_); }
  /// displacement per step along y, from one in the falling frame
  Fixed falling(Fixed uy) const { return wrapped_sum(uy, fallen_); }
  Fixed fall() const { return fall_; }
  /// quanta per step^2 over m/s^2
  const Eigen::Vector2d& kick_per_acceleration() const { return kick_; }

private:
  static Eigen::Vector2d scaled(Fixed x, Fixed y, const Eigen::Vector2d& unit) {
    return {static_cast<double>(x) * unit.x(), static_cast<double>(y) * unit.y()};
  }

  Fixed fall_, fallen_;
  Eigen::Vector2d metres_, velocity_, kick_;
};

/// From the motion in SI units; `last_kick` is what the relative velocity (m/s) gained in a step by
/// the accelerations of the step before.
inline Encounter encounter(const Eigen::Vector2d& separation, const Eigen::Vector2d& half_step,
                           const Eigen::Vector2d& last_kick, double reach, double reduced_mass) {
  return {.x = separation.x(),
          .y = separation.y(),
          .vx = half_step.x() + 0.5 * last_kick.x(),
          .vy = half_step.y() + 0.5 * last_kick.y(),
          .half_vx = half_step.x(),
          .half_vy = half_step.y(),
          .reach = reach,
          .reduced_mass = reduced_mass};
}

/// Two free grains as they meet in this step.
inline Encounter encounter(const Grains& g, std::uint32_t i, std::uint32_t j,
                           const StepUnits& units) {
  return encounter(
      units.metres(wrapped_difference(g.x[j], g.x[i]), wrapped_difference(g.y[j], g.y[i])),
      units.velocity(wrapped_difference(g.ux[j], g.ux[i]), wrapped_difference(g.uy[j], g.uy[i])),
      units.velocity(wrapped_difference(g.kick_x[j], g.kick_x[i]),
                     wrapped_difference(g.kick_y[j], g.kick_y[i])),
      g.radius[i] + g.radius[j], g.mass[i] * g.mass[j] / (g.mass[i] + g.mass[j]));
}

/// A free grain and a fixed wall grain at (line, y).
inline Encounter encounter(const Grains& g, std::uint32_t i, Fixed line, Fixed y,
                           double wall_radius, const StepUnits& units) {
  return encounter(units.metres(wrapped_difference(line, g.x[i]), wrapped_difference(y, g.y[i])),
                   -units.velocity(g.ux[i], units.falling(g.uy[i])),
                   -units.velocity(g.kick_x[i], wrapped_sum(g.kick_y[i], units.fall())),
                   g.radius[i] + wall_radius, g.mass[i]);
}

/// Whether the two bodies touch: the one test that decides about the beginning and the end of a
/// contact.
inline bool overlapping(const Encounter& e) { return e.x * e.x + e.y * e.y < e.reach * e.reach; }

}  // namespace riesel
