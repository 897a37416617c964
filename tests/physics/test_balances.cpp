// The balances of momentum and energy of many grains.
#include "engine/observables.hpp"
#include "engine/simulation.hpp"
#include "tests/catch.hpp"
#include "tests/engine/systems.hpp"
#include "tests/ordered_grains.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

using namespace systems;

namespace {

/// Grains that fly freely out of the box are few in these times: walls are not needed.
State gas_without_walls(double polydispersity, const Dice& seed) {
  State state = empty_box(20e-3, 10e-3);
  Dice dice = seed;
  throw_grains(state, 40,
               {.left = 7e-3,
                .right = 13e-3,
                .low = 0.0,
                .high = state.box.length,
                .speed = 3.0,
                .polydispersity = polydispersity},
               dice);
  return state;
}

State walled_gas(double dt, double gravity, std::uint64_t seed) {
  State state = empty_box(8e-3, 9.6e-3);
  state.time_step = dt;
  state.gravity.y = gravity;
  add_walls(state, 8);
  Dice dice(seed);
  throw_grains(
      state, 40,
      {.left = 0.0, .right = 8e-3, .low = 0.0, .high = 9.6e-3, .speed = 3.0, .common_vy = 2.0},
      dice);
  return state;
}

/// Some hundred encounters, oblique and spinless, of two grains and of grains with the walls, each
/// by itself: the same for any time step, as no error of one becomes the start of the next.
State encounters(double dt, std::uint64_t seed, double inertia = 0.0) {
  constexpr int rows = 100;
  constexpr double apart = 8e-3;  // m, more than they fly
  State state = empty_box(40e-3, rows * apart);
  state.time_step = dt;
  state.gravity.y = 10.0;
  add_walls(state, std::int64_t{8} * rows);
  state.grains.inertia = inertia;
  Dice dice(seed);
  const auto gap = [&] { return dice.between(0.05e-3, 0.3e-3); };
  for (int row = 0; row < rows; ++row) {
    const double y = (row + 0.5) * apart;
    for (int column = 1; column < 5; ++column) {
      const double x = column * apart, angle = dice.between(0.0, 2.0 * std::numbers::pi);
      const double nx = std::cos(angle), ny = std::sin(angle), distance = 2.0 * radius + gap();
      const double vx = dice.between(-1.0, 1.0), vy = dice.between(-1.0, 3.0);
      const double approach = dice.between(0.5, 3.0), slip = dice.between(-3.0, 3.0);
      add_grain(state, grain(x, y, vx + approach * nx - slip * ny, vy + approach * ny + slip * nx));
      add_grain(state, grain(x + distance * nx, y + distance * ny, vx, vy));
    }
    const double from_line = radius + wall_radius + gap();
    add_grain(state, grain(from_line, y, -dice.between(0.5, 3.0), dice.between(-1.0, 3.0)));
    add_grain(state, grain(state.box.width - from_line, y, dice.between(0.5, 3.0),
                           dice.between(-1.0, 3.0)));
  }
  return state;
}

/// kg m/s, with the kicks that the next step takes up, as integer_momentum().
std::array<double, 2> momentum(const State& state) {
  const Grains& g = state.grains;
  const double to_vx = state.box.quantum_x() / state.time_step;
  const double to_vy = state.box.quantum_y() / state.time_step;
  ExactSum x, y;
  for (std::size_t i = 0; i < g.size(); ++i) {
    x.add(g.mass[i] * static_cast<double>(wrapped_sum(g.u[i].x, g.kick[i].x)) * to_vx);
    y.add(g.mass[i] * static_cast<double>(wrapped_sum(g.u[i].y, g.kick[i].y)) * to_vy);
  }
  return {x.value(), y.value()};
}

}  // namespace

TEST_CASE("grains of equal mass conserve momentum to the last bit") {
  // Action and reaction are the same integer with two signs, friction and damping or not.
  const ContactModel model = GENERATE(paper_model(), frictionless(0.0));
  const State start = gas_without_walls(0.0, Dice(51));
  Simulation simulation(start, model, 1);
  for (int i = 0; i < 20; ++i) {
    simulation.advance(50);
    CHECK(integer_momentum(simulation.state()) == integer_momentum(start));
  }
  CHECK(simulation.state().tally.grains.begun > 30);
}

TEST_CASE("grains of unequal mass conserve momentum to rounding") {
  // Each kick is rounded to a quantum per step: half a quantum for each of the two grains of a
  // contact, each step. That adds up like a walk, but is bounded by a straight line.
  const State start = gas_without_walls(0.2, Dice(52));
  const State end = advanced(start, paper_model(), 1000);
  REQUIRE(end.tally.grains.begun > 30);
  const double contact_steps = static_cast<double>(end.tally.grains.begun)
                               + end.tally.grains.duration.value() / end.time_step
                               + 1000.0 * static_cast<double>(end.contacts.size());
  const double heaviest = *std::max_element(start.grains.mass.begin(), start.grains.mass.end());
  const double quantum = std::max(start.box.quantum_x(), start.box.quantum_y());
  const double bound = contact_steps * heaviest * quantum / start.time_step;
  CHECK(bound < 1e-12 * 40.0 * mass * 3.0);
  for (std::size_t axis = 0; axis < 2; ++axis)
    CHECK(std::abs(momentum(end)[axis] - momentum(start)[axis]) < bound + 1e-19);
}

TEST_CASE("the momentum along a tube is that of its start, of gravity and of the walls") {
  const State start = walled_gas(time_step, 10.0, 53);
  const State end = advanced(start, paper_model(), 3000);
  REQUIRE(end.tally.walls.begun > 20);
  const double weight = 40.0 * mass * end.gravity.y;
  const double expected = end.origin.momentum_y + weight * end.time() + observe(end).wall_impulse_y;
  // U is the velocity in the falling frame, half a step of gravity behind; it starts half a step of
  // gravity low.
  const double moved = momentum(end)[1] + weight * (end.time() + 0.5 * time_step);
  CHECK(std::abs(moved - expected) < 1e-10 * 40.0 * mass);
}

TEST_CASE("an elastic gas without friction keeps its energy, the better the smaller the step") {
  // One collision errs by up to 5e-4 of its energy at t_col / 50, of either sign and second order
  // in dt; 3000 collisions of 40 grains walk to some 1e-3 of the whole.
  const auto largest_error = [](double dt) {
    Simulation simulation(walled_gas(dt, 0.0, 54), frictionless(0.0), 1);
    const double start = observe(simulation.state()).energies.kinetic;
    double largest = 0.0;
    for (int i = 0; i < 40; ++i) {
      simulation.advance(std::llround(5e-4 / dt));
      const Energies e = observe(simulation.state()).energies;
      CHECK(e.normal_loss == 0.0);
      CHECK(e.friction_loss == 0.0);
      largest = std::max(largest, std::abs((e.kinetic + e.elastic) / start - 1.0));
    }
    CHECK(simulation.state().tally.grains.begun > 1000);
    return largest;
  };
  CHECK(largest_error(1e-6) < 3e-3);
  CHECK(largest_error(0.25e-6) < 3e-3 / 8.0);  // a sixteenth, and a factor of two for chance
}

TEST_CASE("the energy of a dissipative tube is accounted for, the better the smaller the step") {
  // residual = start + work of gravity - kinetic - elastic - losses
  const auto seed = GENERATE(as<std::uint64_t>{}, 55, 56, 57);
  const auto residual = [&](double dt) {
    Simulation simulation(walled_gas(dt, 10.0, seed), paper_model(), 1);
    simulation.advance(std::llround(5e-3 / dt));
    const Energies e = observe(simulation.state()).energies;
    CHECK(e.normal_loss > 0.0);
    CHECK(e.friction_loss > 0.0);
    CHECK(e.gravity_work > 0.0);
    return std::abs(e.residual) / (e.normal_loss + e.friction_loss);
  };
  const double coarse = residual(2e-6), middle = residual(1e-6), fine = residual(0.25e-6);
  CHECK(middle < 2e-3);
  CHECK(middle < 0.5 * coarse);  // second order: a quarter, and the runs are different ones
  CHECK(fine < 0.2 * middle);
}

TEST_CASE("the energy of a tube at an angle is accounted for, the better the smaller the step") {
  const auto residual = [&](double dt) {
    State start = walled_gas(dt, 300.0, 59);
    start.gravity.x = -400.0;
    const Energies e = observe(advanced(start, paper_model(), std::llround(5e-3 / dt))).energies;
    CHECK(e.gravity_work > 0.0);
    return std::abs(e.residual) / (e.normal_loss + e.friction_loss);
  };
  const double coarse = residual(2e-6), fine = residual(0.25e-6);
  CHECK(coarse < 0.01);
  CHECK(fine < 0.1 * coarse);
}

TEST_CASE("the energy between moving walls is accounted for, the better the smaller the step") {
  WallMotion motion;
  SECTION("at constant velocity") { motion = {.velocity = 5.0}; }
  SECTION("to and fro") { motion = {.amplitude_y = 0.5e-3, .frequency = 1500.0}; }
  SECTION("across") { motion = {.amplitude_x = 0.3e-3, .frequency = 400.0}; }
  const auto residual = [&](double dt) {
    State start = walled_gas(dt, 0.0, 60);
    start.walls[0].motion = motion;
    start.walls[1].motion = {.velocity = -motion.velocity};
    const Energies e = observe(advanced(start, paper_model(), std::llround(5e-3 / dt))).energies;
    CHECK(e.wall_work > 0.1 * e.kinetic);
    return std::abs(e.residual) / (e.normal_loss + e.friction_loss);
  };
  const double coarse = residual(2e-6), fine = residual(0.25e-6);
  CHECK(coarse < 0.01);
  CAPTURE(coarse, fine);
  CHECK(fine < 0.025 * coarse);  // second order: an eighth of the step, and a 64th of the residual
}

TEST_CASE("the residual of the energy vanishes at second order in the time step") {
  const auto seed = GENERATE(as<std::uint64_t>{}, 1, 2);
  const double gamma_n = GENERATE(1e4, 2e3), mu = GENERATE(0.0, friction);
  const ContactModel model{LinearLaw{stiffness, gamma_n}, CappedSlip{}, mu, Attraction::keep};
  const auto residual = [&](double dt) {
    const State end = advanced(encounters(dt, seed), model, std::llround(0.8e-3 / dt));
    CHECK(end.tally.grains.begun > 300);
    CHECK(end.tally.walls.begun > 150);
    const Energies e = observe(end).energies;
    return std::abs(e.residual) / (e.normal_loss + e.friction_loss);
  };
  // t_col / 25 to t_col / 200: an eighth of the step, and a 64th of the residual.
  const double coarse = residual(2e-6), fine = residual(0.25e-6);
  CAPTURE(seed, gamma_n, mu, coarse, fine);
  CHECK(std::log2(coarse / fine) / 3.0 == Approx(2.0).margin(0.25));
  CHECK(coarse < 6e-3);
}

TEST_CASE("the residual of the energy vanishes with the time step where grains rotate") {
  // Second order but for where a contact comes to pull, which is of the first.
  ContactModel model = rolling_model();
  model.attraction = Attraction::clip;
  const SlipLaw slip = GENERATE(SlipLaw(CappedSlip{}), SlipLaw(SpringSlip{800.0, 3e3}));
  model.slip = slip;
  const double inertia = GENERATE(0.0, disc);
  const auto residual = [&](double dt) {
    const State end = advanced(encounters(dt, 3, inertia), model, std::llround(0.8e-3 / dt));
    const Energies e = observe(end).energies;
    CHECK((e.rotational > 0.0) == (inertia > 0.0));
    return std::abs(e.residual) / (e.normal_loss + e.friction_loss);
  };
  const double coarse = residual(2e-6), fine = residual(0.25e-6);
  CAPTURE(inertia, coarse, fine);
  CHECK(std::log2(coarse / fine) / 3.0 > 1.5);
  CHECK(coarse < 6e-3);
}

TEST_CASE("the work of gravity is the weight times the way of the centre of mass") {
  // Followed step by step in a short tube that the grains cross several times.
  const State start = walled_gas(time_step, 10.0, 58);
  Simulation simulation(start, paper_model(), 1);
  double way = 0.0;  // sum over grains, m
  Grains before = ordered_by_id(start.grains);
  for (int i = 0; i < 1000; ++i) {
    simulation.advance(1);
    const Grains now = ordered_by_id(simulation.state().grains);
    for (std::size_t g = 0; g < now.size(); ++g)
      way += start.box.metres_y(wrapped_difference(now.position[g].y, before.position[g].y));
    before = now;
  }
  const double work = observe(simulation.state()).energies.gravity_work;
  CHECK(std::abs(work / (mass * 10.0 * way) - 1.0) < 1e-7);
}
