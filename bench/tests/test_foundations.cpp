// What measurements rest on: that long tubes hold the flow of the short one of which they are
// copies, that the scalar reference does the same physics as the engine, how repetitions are
// counted, with which bandwidth speeds are compared.
#include "bench/results.hpp"
#include "bench/scalar_reference.hpp"
#include "bench/start_states.hpp"
#include "bench/timing.hpp"
#include "bench/traffic.hpp"
#include "engine/closed_forms.hpp"
#include "engine/observables.hpp"
#include "tests/catch.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

using namespace riesel;
using namespace riesel::bench;

namespace {

/// A small tube with a grain at each site of a lattice, moving in all directions.
State small_tube() {
  State state;
  state.box = {.width = 10e-3, .length = 8e-3};
  state.walls = {{.line = 0.0, .radius = 0.33e-3, .count = 8},
                 {.line = 10e-3, .radius = 0.33e-3, .count = 8}};
  state.gravity.y = 10.0;
  state.time_step = 1e-6;
  for (int row = 0; row < 6; ++row)
    for (int column = 0; column < 7; ++column) {
      const double angle = 2.0 * std::numbers::pi * (0.37 * row + 0.61 * column);
      add_grain(state, {.x = 1e-3 + 1.3e-3 * column,
                        .y = 0.7e-3 + 1.3e-3 * row,
                        .vx = 0.5 * std::cos(angle),
                        .vy = 1.0 + 0.5 * std::sin(angle),
                        .radius = 0.5e-3,
                        .mass = 1e-6});
    }
  return state;
}

ContactModel elastic() { return {.normal = LinearLaw{2000.0, 0.0}, .slip = CappedSlip{}}; }

}  // namespace

TEST_CASE("copies stand one after the other, and so do their walls") {
  const State tile = small_tube();
  const State three = repeated(tile, 3);
  REQUIRE(three.grains.size() == 3 * tile.grains.size());
  CHECK(three.box.length == Approx(3.0 * tile.box.length));
  CHECK(three.walls[1].spacing(three.box) == Approx(tile.walls[1].spacing(tile.box)));
  for (std::size_t i = 0; i < three.grains.size(); ++i) {
    const Grain copy = grain_at(three, i), original = grain_at(tile, i % tile.grains.size());
    const std::size_t number = i / tile.grains.size();
    CHECK(copy.x == Approx(original.x));
    CHECK(copy.y == Approx(original.y + static_cast<double>(number) * tile.box.length));
    CHECK(copy.radius == original.radius);
    CHECK(copy.mass == original.mass);
  }
}

TEST_CASE("copies have nearly the same velocities, but each grain its own") {
  const State tile = small_tube();
  const State many = repeated(tile, 50);
  const Observables before = observe(tile), after = observe(many);
  CHECK(after.mean_vy == Approx(before.mean_vy).margin(0.005));
  // A change of a tenth adds a hundredth to the temperature.
  CHECK(after.granular_temperature / before.granular_temperature == Approx(1.01).margin(0.01));
  CHECK(grain_at(many, 0).vx != grain_at(many, tile.grains.size()).vx);
}

TEST_CASE("a state that has been stepped is copied with its positions and velocities of now") {
  Simulation simulation(small_tube(), elastic(), 1);
  simulation.advance(500);
  const State copy = repeated(simulation.state(), 1);
  const double change = 0.1 * std::sqrt(observe(simulation.state()).granular_temperature);
  for (std::size_t i = 0; i < copy.grains.size(); ++i) {
    const Grain now = grain_at(simulation.state(), i), then = grain_at(copy, i);
    CHECK(then.x == Approx(now.x));
    CHECK(then.y == Approx(now.y));
    CHECK(std::abs(then.vx - now.vx) < 5.0 * change);
    CHECK(std::abs(then.vy - now.vy) < 5.0 * change);
  }
}

TEST_CASE("contenders are measured in turns") {
  std::string order;
  const auto contender = [&](char name, double seconds) {
    return [&order, name, seconds] {
      order += name;
      return seconds;
    };
  };
  const auto timings = in_turns({contender('a', 1.0), contender('b', 2.0)}, 3);
  CHECK(order == "ababab");
  CHECK(timings[1].seconds == std::vector{2.0, 2.0, 2.0});
}

TEST_CASE("least and median of repetitions") {
  CHECK(Timing{{3.0, 1.0, 2.0}}.least() == 1.0);
  CHECK(Timing{{3.0, 1.0, 2.0}}.median() == 2.0);
  CHECK(Timing{{4.0, 1.0, 2.0, 10.0}}.median() == 3.0);
}

TEST_CASE("the bandwidth is that of the fastest set which is large enough, or of the largest") {
  // 4/3 of the set are moved in a pass.
  const auto measured = [](int threads, std::size_t megabytes, double gigabytes_per_second) {
    const auto bytes = static_cast<double>(megabytes) * 1e6;
    return Bandwidth{.threads = threads,
                     .working_set = megabytes * 1'000'000,
                     .timing = {{bytes * 4.0 / 3.0 / (gigabytes_per_second * 1e9)}}};
  };
  const std::vector all = {measured(1, 10, 40.0), measured(1, 100, 11.0), measured(1, 200, 13.0),
                           measured(1, 400, 12.0), measured(2, 400, 20.0)};
  CHECK(bandwidth_for(all, 1, 5e6).value() == Approx(40e9));
  CHECK(bandwidth_for(all, 1, 50e6).value() == Approx(13e9));
  CHECK(bandwidth_for(all, 1, 300e6).value() == Approx(12e9));
  CHECK(bandwidth_for(all, 1, 1e12).value() == Approx(12e9));
  CHECK(bandwidth_for(all, 2, 5e6).value() == Approx(20e9));
  CHECK_FALSE(bandwidth_for(all, 3, 5e6));
}

TEST_CASE("the traffic of grains that are far from each other is that of flying and looking") {
  State state = small_tube();
  state.walls.clear();
  state.box.length = 1.0;
  for (std::size_t i = 0; i < state.grains.size(); ++i)
    state.grains.position[i].y = state.box.fixed_y(0.02 * static_cast<double>(i));
  // 8 + 16 + 8 for each axis, and both coarse coordinates once more.
  CHECK(plain_traffic(state) == 2 * 32 + 8);
}

TEST_CASE("the traffic of a contact is that of the rows that change in a step") {
  State state;
  state.box = {.width = 10e-3, .length = 8e-3};
  state.time_step = 1e-6;
  for (const double side : {-1.0, 1.0})
    add_grain(state, {.x = 5e-3 + side * 0.5001e-3,
                      .y = 4e-3,
                      .vx = -side,
                      .vy = 0.0,
                      .radius = 0.5e-3,
                      .mass = 1e-6});
  Simulation simulation(state, elastic(), 1);
  simulation.advance(4);
  State touching = simulation.state();
  REQUIRE(touching.contacts.size() == 1);
  const double with = plain_traffic(touching);
  touching.contacts.clear();
  // Nine rows of its life and six of its motion twice, six constants, four kicks and a flag; for
  // each grain twelve words and two entries of a list. It is not searched for; two grains share it.
  const double contact = 2 * (9 + 6) * 8 + 6 * 8 + 4 * 8 + 4 + 2 * (12 * 8 + 2 * 4), pair = 12;
  CHECK(with - plain_traffic(touching) == Approx((contact - pair) / 2));
}

TEST_CASE("the scalar reference brakes and loses energy as the engine does") {
  const ContactModel model{
      .normal = LinearLaw{2000.0, 3000.0}, .slip = CappedSlip{}, .friction = 0.5};
  const State start = small_tube();
  Simulation simulation(start, model, 1);
  ScalarReference reference(start, model);
  simulation.advance(2000);
  reference.advance(2000);
  const double before = observe(start).mean_vy, after = observe(simulation.state()).mean_vy;
  REQUIRE(simulation.state().tally.walls.begun > 5);
  REQUIRE(simulation.state().tally.grains.begun > 5);
  CHECK(std::abs(reference.mean_vy() - after) < 0.01 * std::abs(after - before));
  const double energy = observe(simulation.state()).energies.kinetic;
  const double lost = observe(start).energies.kinetic - energy;
  REQUIRE(lost > 0.1 * energy);
  CHECK(std::abs(reference.kinetic_energy() - energy) < 0.01 * lost);
}

TEST_CASE("the scalar reference refuses what it does not know") {
  ContactModel model{.normal = LinearLaw{2000.0, 3000.0}, .slip = CappedSlip{}, .friction = 0.5};
  State state = small_tube();
  CHECK_NOTHROW(ScalarReference(state, model));
  SECTION("another law") { model.slip = LiteralSlip{}; }
  SECTION("contacts that may not pull") { model.attraction = Attraction::clip; }
  SECTION("grains that rotate") { state.grains.inertia = 0.5; }
  SECTION("gravity across the tube") { state.gravity.x = 1.0; }
  SECTION("smooth walls") {
    for (WallLattice& wall : state.walls) wall = WallLattice::smooth_at(wall.line);
  }
  SECTION("walls that differ") { state.walls.back().count *= 2; }
  SECTION("walls that move") { state.walls.front().motion.velocity = 1.0; }
  CHECK_THROWS_AS(ScalarReference(state, model), std::invalid_argument);
}
