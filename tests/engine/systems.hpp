// Small systems to try the engine on, made of the grains of the paper's own numbers.
#pragma once

#include "engine/contact_law.hpp"
#include "engine/simulation.hpp"
#include "engine/state.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace systems {

using namespace riesel;

inline constexpr double radius = 0.5e-3;        // m
inline constexpr double wall_radius = 0.33e-3;  // m
inline constexpr double mass = 1e-6;            // kg
inline constexpr double stiffness = 2000.0;     // N/m
inline constexpr double damping = 1e4;          // 1/s, e_N = 0.70 at the wall
inline constexpr double friction = 0.5;
inline constexpr double time_step = 1e-6;  // s, t_col / 50 of two free grains

inline ContactModel paper_model() {
  return {LinearLaw{stiffness, damping}, CappedSlip{}, friction, Attraction::keep};
}

/// Of grains that rotate: a spring that is stretched and slides, and resistance to rolling.
inline ContactModel rolling_model() {
  return {LinearLaw{stiffness, damping}, SpringSlip{0.4 * stiffness, 0.3 * damping}, friction,
          Attraction::keep, 0.1};
}

inline constexpr double disc = 0.5, sphere = 0.4;  // moments of inertia over m r^2

inline ContactModel frictionless(double gamma_n) {
  return {LinearLaw{stiffness, gamma_n}, CappedSlip{}, 0.0, Attraction::keep};
}

/// Random numbers that are the same with every standard library.
class Dice {
public:
  explicit Dice(std::uint64_t seed) : bits_(seed) {}

  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(bits_() >> 11) * 0x1p-53;
  }
  std::int64_t below(std::int64_t n) {
    return static_cast<std::int64_t>(bits_() % static_cast<std::uint64_t>(n));
  }

private:
  std::mt19937_64 bits_;
};

inline State empty_box(double width, double length) {
  State state;
  state.box = {.width = width, .length = length};
  state.time_step = time_step;
  return state;
}

/// Walls at x = 0 and x = width, `count` grains each.
inline void add_walls(State& state, std::int64_t count) {
  for (const double line : {0.0, state.box.width})
    state.walls.push_back({.line = line, .radius = wall_radius, .count = count});
}

/// A grain of the paper's size.
inline Grain grain(double x, double y, double vx, double vy) {
  return {.x = x, .y = y, .vx = vx, .vy = vy, .radius = radius, .mass = mass};
}

/// Whether a grain there would overlap one of `state` or stand in a wall.
inline bool room_for(const State& state, const Grain& newcomer) {
  for (const WallLattice& wall : state.walls)
    if (std::abs(newcomer.x - wall.line) < newcomer.radius + wall.radius) return false;
  for (std::size_t slot = 0; slot < state.grains.size(); ++slot) {
    const Grain other = grain_at(state, slot);
    const double y = std::remainder(newcomer.y - other.y, state.box.length);
    if (std::hypot(newcomer.x - other.x, y) < newcomer.radius + other.radius) return false;
  }
  return true;
}

/// Where grains are thrown to, and how fast.
struct Throw {
  double left, right;           ///< m, range of x
  double low, high;             ///< m, range of y
  double speed;                 ///< m/s, bound on the random part of each velocity component
  double common_vy = 0.0;       ///< m/s
  double polydispersity = 0.0;  ///< relative half width of the radii; mass ~ r^2
  double mean_radius = radius;  ///< m
};

/// Adds grains at random places where they touch nothing. If they rotate, their surfaces are as
/// fast as they are.
inline void throw_grains(State& state, std::size_t count, const Throw& where, Dice& dice) {
  for (int attempts = 0; count > 0; ++attempts) {
    if (attempts > 1'000'000) throw std::runtime_error("there is no room for so many grains");
    const double size = dice.between(1.0 - where.polydispersity, 1.0 + where.polydispersity);
    const double r = where.mean_radius * size;
    Grain g{.x = dice.between(where.left, where.right),
            .y = dice.between(where.low, where.high),
            .vx = dice.between(-where.speed, where.speed),
            .vy = where.common_vy + dice.between(-where.speed, where.speed),
            .radius = r,
            .mass = mass * r * r / (radius * radius)};
    if (state.grains.rotate()) g.spin = dice.between(-where.speed, where.speed) / r;
    if (!room_for(state, g)) continue;
    add_grain(state, g);
    --count;
  }
}

struct TubePiece {
  double length;  ///< m, of a tube 8 mm wide
  std::int64_t wall_grains;
  std::size_t grains;
  double speed, polydispersity;  ///< as in Throw
  double inertia = 0.0;
};

inline State corrugated_tube(std::uint64_t seed, const TubePiece& piece) {
  State state = empty_box(8e-3, piece.length);
  state.gravity.y = 10.0;
  state.grains.inertia = piece.inertia;
  add_walls(state, piece.wall_grains);
  Dice dice(seed);
  throw_grains(state, piece.grains,
               {.left = 0.0,
                .right = state.box.width,
                .low = 0.0,
                .high = state.box.length,
                .speed = piece.speed,
                .common_vy = 2.0,
                .polydispersity = piece.polydispersity},
               dice);
  return state;
}

/// A crowded piece of the corrugated tube, in which every grain soon touches others and the walls.
inline State small_tube(std::uint64_t seed, std::size_t grains = 40, double inertia = 0.0) {
  return corrugated_tube(seed, {.length = 9.6e-3,
                                .wall_grains = 8,
                                .grains = grains,
                                .speed = 3.0,
                                .polydispersity = 0.1,
                                .inertia = inertia});
}

/// The same grains in other slots.
inline State shuffled(State state, std::uint64_t seed) {
  Dice dice(seed);
  Grains& g = state.grains;
  for (auto i = static_cast<std::int64_t>(g.size()) - 1; i > 0; --i) {
    const auto a = static_cast<std::size_t>(i);
    const auto b = static_cast<std::size_t>(dice.below(i + 1));
    for (auto* vectors : {&g.position, &g.u, &g.kick}) std::swap((*vectors)[a], (*vectors)[b]);
    std::swap(g.radius[a], g.radius[b]);
    std::swap(g.mass[a], g.mass[b]);
    std::swap(g.id[a], g.id[b]);
    if (!g.rotate()) continue;
    std::swap(g.spin[a], g.spin[b]);
    std::swap(g.spin_kick[a], g.spin_kick[b]);
  }
  return state;
}

/// The grain with this id, wherever the store keeps it.
inline Grain grain_of_id(const State& state, std::int32_t id) {
  std::size_t slot = 0;
  while (state.grains.id[slot] != id) ++slot;
  return grain_at(state, slot);
}

/// `state` after `steps` steps. A test of several threads has to say how they step: few grains are
/// stepped by one of them where the choice is free.
inline State advanced(const State& state, const ContactModel& model, std::int64_t steps,
                      int threads, Stepping stepping) {
  Simulation simulation(state, model, threads, stepping);
  simulation.advance(steps);
  return simulation.state();
}

inline State advanced(const State& state, const ContactModel& model, std::int64_t steps) {
  return advanced(state, model, steps, 1, Stepping::automatic);
}

/// What `run` fails with, or "no failure".
template <class Run>
std::string failure_of(Run run) {
  try {
    run();
  } catch (const RunFailure& failure) {
    return failure.what();
  }
  return "no failure";
}

/// Sums of the displacements per step, with the kicks that the next step takes up.
inline std::array<Fixed, 2> integer_momentum(const State& state) {
  const Grains& g = state.grains;
  std::array<Fixed, 2> sum{};
  for (std::size_t i = 0; i < g.size(); ++i) {
    sum[0] = wrapped_sum(sum[0], wrapped_sum(g.u[i].x, g.kick[i].x));
    sum[1] = wrapped_sum(sum[1], wrapped_sum(g.u[i].y, g.kick[i].y));
  }
  return sum;
}

}  // namespace systems
