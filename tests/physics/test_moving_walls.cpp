// One grain and a smooth wall that moves across: what mechanics says of bats and of shaken plates.
#include "engine/closed_forms.hpp"
#include "engine/observables.hpp"
#include "engine/simulation.hpp"
#include "tests/catch.hpp"
#include "tests/engine/systems.hpp"

#include <cmath>
#include <numbers>

using namespace systems;
using std::numbers::pi;

namespace {

constexpr double weight_per_mass = 10.0;  // m/s^2

State plate(const WallMotion& motion) {
  State state = empty_box(10e-3, 20e-3);
  state.walls = {WallLattice::smooth_at(0.0)};
  state.walls[0].motion = motion;
  return state;
}

/// A grain that lies on a plate shaken with `gamma` times the weight, from the lowest point on.
struct Shaken {
  explicit Shaken(double gamma)
      : amplitude(gamma * weight_per_mass / (omega * omega)), state(plate({})) {
    state.gravity.x = -weight_per_mass;
    state.walls[0].motion = {
        .amplitude_x = amplitude, .frequency = omega / (2.0 * pi), .phase = -0.5 * pi};
    const double overlap = mass * weight_per_mass * (1.0 + gamma) / stiffness;
    add_grain(state, grain(radius - amplitude - overlap, 5e-3, 0.0, 0.0));
  }

  double omega = 100.0 * pi;  // rad/s
  double amplitude;           // m
  State state;
};

}  // namespace

TEST_CASE("a plate that comes throws a grain at rest as an impact on a wall at rest does") {
  const double omega = 40.0 * pi, amplitude = 1e-3, speed = amplitude * omega;
  const double sign = GENERATE(1.0, -1.0);  // either by the amplitude or by the frequency
  State state = plate({.amplitude_x = sign * amplitude, .frequency = sign * omega / (2.0 * pi)});
  add_grain(state, grain(radius + 1e-6, 5e-3, 0.0, 0.0));
  const State end = advanced(state, frictionless(damping), 400);
  CHECK(end.tally.walls.ended == 1);

  const double restitution = LinearContact{stiffness, damping, mass}.restitution();
  const double thrown = (1.0 + restitution) * speed;
  CHECK(grain_at(end, 0).vx == Approx(thrown).epsilon(5e-3));
  const Energies e = observe(end).energies;
  CHECK(e.wall_work == Approx(mass * thrown * speed).epsilon(5e-3));
  CHECK(std::abs(e.residual) < 2e-3 * e.wall_work);
}

TEST_CASE("a grain stays on a plate that is shaken with less than its weight") {
  const Shaken shaken(0.9);
  const State end = advanced(shaken.state, frictionless(damping), 60'000);  // three periods
  CHECK(end.tally.walls.begun <= 1);
  CHECK(end.tally.walls.ended == 0);
  const double way = end.walls[0].motion.way(end.box, end.time()).x;
  CHECK(grain_at(end, 0).x
        == Approx(radius + way).margin(2.0 * mass * weight_per_mass / stiffness));
}

TEST_CASE("a grain leaves a plate that is shaken with more than its weight where the two part") {
  const double gamma = GENERATE(1.1, 2.0);
  const Shaken shaken(gamma);
  Simulation simulation(shaken.state, frictionless(damping), 1);
  simulation.advance(1000);
  while (!simulation.state().contacts.empty() && simulation.state().time() < 0.02)
    simulation.advance(1);
  const State& end = simulation.state();
  CHECK(end.time() == Approx((0.5 * pi + std::asin(1.0 / gamma)) / shaken.omega).epsilon(0.01));
  const double speed = shaken.amplitude * shaken.omega * std::sqrt(1.0 - 1.0 / (gamma * gamma));
  CHECK(grain_at(end, 0).vx == Approx(speed).epsilon(0.02));
}
