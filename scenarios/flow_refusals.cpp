#include "scenarios/flow_refusals.hpp"

#include "engine/exact_sum.hpp"
#include "engine/observables.hpp"
#include "scenarios/run_length.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace riesel::scenarios {

namespace {

/// A grain that falls freely from one look to the next must not get so fast that its velocity wraps
/// around and seems slow again.
void reject_strong_gravity(const io::Settings& settings, std::size_t grains, const State& state) {
  const double largest = largest_speed(state.box, state.time_step, grains)
                         / (static_cast<double>(steps_per_look) * state.time_step);
  if (std::hypot(state.gravity.x, state.gravity.y) < largest) return;
  settings.reject(
      "gravity",
      fmt::format("too strong for this tube and a time step of {:.3g} s", state.time_step),
      fmt::format("choose less than {:.3g} m/s^2, or a shorter time step: a light grain or a stiff "
                  "contact (do grains.mass and contact.stiffness have their units?)",
                  largest));
}

/// Velocities change by whole quanta in a step. If the step is very short, or gravity very weak,
/// rounding makes gravity differ from what is set.
void reject_rounded_gravity(const io::Settings& settings, const State& state) {
  constexpr double tolerated = 1e-3;  // of gravity
  const Box& box = state.box;
  const FixedVector fall = fall_per_step(state);
  const double per_step2 = 1.0 / (state.time_step * state.time_step);
  const double gravity = std::hypot(state.gravity.x, state.gravity.y);
  // Of each component by itself, as a small one along the walls is what drives the flow; but not of
  // what is left of a right angle by rounding.
  const auto off = [&](double wanted, double in_a_step) {
    constexpr double rounding = 1e-12;
    return std::abs(wanted) > rounding * gravity
               ? std::abs(in_a_step * per_step2 - wanted) / std::abs(wanted)
               : 0.0;
  };
  const double error = std::max(off(state.gravity.x, box.metres_x(fall.x)),
                                off(state.gravity.y, box.metres_y(fall.y)));
  if (error <= tolerated) return;
  constexpr auto steps_key = "run.steps_per_collision";
  settings.reject(
      settings.given(steps_key) ? steps_key : "gravity",
      fmt::format("with a time step of {:.3g} s gravity along an axis would be wrong by "
                  "{:.2g} %, because the velocity it adds per step is rounded",
                  state.time_step, 100.0 * error),
      "choose gravity 0 or a stronger one, fewer run.steps_per_collision, softer or "
      "heavier grains, or a smaller system");
}

void reject_fast_grains(const io::Settings& settings, const std::vector<Grain>& grains,
                        const State& state) {
  const double largest = largest_speed(state.box, state.time_step, grains.size());
  double fastest = 0.0;
  for (const Grain& g : grains) fastest = std::max(fastest, std::hypot(g.vx, g.vy));
  if (fastest < largest) return;
  const std::string problem = "too fast for this tube and time step";
  const std::string remedy =
      fmt::format("choose velocities with which the fastest grain, now {:.3g} m/s, stays below "
                  "{:.3g} m/s",
                  fastest, largest);
  const std::string kind = settings.text("start.kind");
  if (kind == "file") settings.reject("start.from", problem, remedy);
  if (kind == "continued")
    settings.reject("start.from", "has grains too fast for this tube and time step",
                    remedy + ", or stiffer contacts, whose time step is shorter");
  const double random = std::abs(settings.number("start.random_velocity")),
               common = std::abs(settings.number("start.axial_velocity"));
  const double of_walls = std::abs(state.walls.back().motion.velocity);
  if (of_walls > std::max(random, common))
    settings.reject(
        "cell.velocity", "makes grains too fast for this cell and time step",
        fmt::format("choose velocities of walls and grains of less than {:.3g} m/s together",
                    largest));
  settings.reject(random > common ? "start.random_velocity" : "start.axial_velocity", problem,
                  remedy);
}

/// At most an eighth of a turn in a step: a few times more would wrap around and seem slow again.
/// And their sum, and that of the squares of the velocities of their rims, must be held.
void reject_fast_spins(const io::Settings& settings, const std::vector<Grain>& grains,
                       const State& state) {
  const double share = ExactSum::largest_sum / static_cast<double>(grains.size());
  const double largest = 0.25 * std::numbers::pi / state.time_step;
  for (const Grain& g : grains) {
    if (std::abs(g.spin) >= largest)
      settings.reject("start.from", "has spins too fast for this time step",
                      fmt::format("choose spins below {:.3g} 1/s", largest));
    const double most = std::min(std::sqrt(share) / g.radius, share);
    if (std::abs(g.spin) >= most)
      settings.reject("start.from", "has spins whose sum or energy is beyond what sums hold",
                      fmt::format("choose spins below {:.3g} 1/s", most));
  }
}

}  // namespace

void reject_unfit_gravity(const io::Settings& settings, std::size_t grains, const State& state) {
  reject_strong_gravity(settings, grains, state);
  reject_rounded_gravity(settings, state);
}

void reject_fast_motion(const io::Settings& settings, const std::vector<Grain>& grains,
                        const State& state) {
  reject_fast_grains(settings, grains, state);
  reject_fast_spins(settings, grains, state);
}

void reject_heavy_grains(const io::Settings& settings, const State& state) {
  const double largest = largest_sum(state);
  if (largest < ExactSum::largest_sum) return;
  settings.reject(settings.text("start.kind") == "fresh" ? "grains.mass" : "start.from",
                  fmt::format("grains so heavy that their masses or energies, {:.3g} in SI units, "
                              "are beyond what sums hold",
                              largest),
                  fmt::format("choose lighter ones, for less than {:.3g} in all (do masses and "
                              "velocities have their units?); stiffness may be scaled with the "
                              "mass, which changes no motion",
                              ExactSum::largest_sum));
}

}  // namespace riesel::scenarios
