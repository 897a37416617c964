// What must not go on: states that are none, grains that get lost, forces that are no numbers.
#include "engine/observables.hpp"
#include "engine/simulation.hpp"
#include "tests/catch.hpp"
#include "tests/engine/systems.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

using namespace systems;
using Catch::Matchers::Contains;

namespace {

State two_grains() {
  State state = empty_box(10e-3, 10e-3);
  add_grain(state, grain(3e-3, 3e-3, 0.0, 0.0));
  add_grain(state, grain(6e-3, 6e-3, 0.0, 0.0));
  return state;
}

void check_refused(const State& state) {
  CHECK_THROWS_AS(Simulation(state, paper_model(), 1), std::invalid_argument);
}

/// What advance() throws, or "no failure".
std::string failure(const State& state, std::int64_t steps, int threads, Stepping stepping) {
  return failure_of([&] { advanced(state, paper_model(), steps, threads, stepping); });
}

std::string failure(const State& state, std::int64_t steps) {
  return failure(state, steps, 1, Stepping::automatic);
}

}  // namespace

TEST_CASE("a valid state is accepted") {
  CHECK_NOTHROW(Simulation(two_grains(), paper_model(), 1));
}

TEST_CASE("a grain whose place or motion integers cannot hold is refused, not wrapped") {
  State state = two_grains();
  const double width = state.box.width, length = state.box.length, dt = state.time_step;
  const double infinite = std::numeric_limits<double>::infinity();
  for (const Grain& bad :
       {grain(4.0 * width, 0.0, 0.0, 0.0), grain(-8.5 * width, 0.0, 0.0, 0.0),
        grain(3e-3, infinite, 0.0, 0.0), grain(3e-3, 0.0, 4.0 * width / dt, 0.0),
        grain(3e-3, 0.0, 0.0, -0.5 * length / dt), grain(3e-3, 0.0, 0.0, std::nan(""))})
    CHECK_THROWS_AS(add_grain(state, bad), std::invalid_argument);
  CHECK(state.grains.size() == 2);
  add_grain(state, grain(3.9 * width, 17.0 * length, 3.9 * width / dt, 0.49 * length / dt));
  const Grain kept = grain_at(state, 2);
  CHECK(kept.x == Approx(3.9 * width));
  CHECK(kept.vx == Approx(3.9 * width / dt));
  CHECK(kept.vy == Approx(0.49 * length / dt));

  State rolling = two_grains();
  rolling.grains = {};
  rolling.grains.inertia = 0.5;
  Grain spinning = grain(3e-3, 0.0, 0.0, 0.0);
  spinning.spin = -1.01 * std::numbers::pi / dt;
  CHECK_THROWS_AS(add_grain(rolling, spinning), std::invalid_argument);
  spinning.spin *= 0.98;
  add_grain(rolling, spinning);
  CHECK(grain_at(rolling, 0).spin == Approx(spinning.spin));
}

TEST_CASE("a state whose invariants do not hold is refused") {
  State state = two_grains();
  SECTION("without grains") { state.grains.resize(0); }
  SECTION("a radius of zero") { state.grains.radius[1] = 0.0; }
  SECTION("a negative radius") { state.grains.radius[1] = -radius; }
  SECTION("a radius that is no number") {
    state.grains.radius[1] = std::numeric_limits<double>::quiet_NaN();
  }
  SECTION("a mass of zero") { state.grains.mass[0] = 0.0; }
  SECTION("a negative mass") { state.grains.mass[0] = -mass; }
  SECTION("an id twice") { state.grains.id[1] = 0; }
  SECTION("an id too large") { state.grains.id[1] = 2; }
  SECTION("a negative id") { state.grains.id[1] = -1; }
  SECTION("a time step of zero") { state.time_step = 0.0; }
  SECTION("a negative time step") { state.time_step = -1e-6; }
  SECTION("a time step that is no number") {
    state.time_step = std::numeric_limits<double>::quiet_NaN();
  }
  check_refused(state);
}

TEST_CASE("a period in which the nearest image is not unique is refused") {
  // Two diameters, at which a grain could touch a neighbour and its image; the engine's candidates
  // may ask for somewhat more.
  State state = empty_box(10e-3, 4.0 * radius);
  add_grain(state, grain(3e-3, 0.0, 0.0, 0.0));
  check_refused(state);
  state.box.length = 8.0 * radius;
  CHECK_NOTHROW(Simulation(state, paper_model(), 1));
}

TEST_CASE("walls of which a grain could touch too many grains at once are refused") {
  State state = two_grains();
  add_walls(state, 1000);
  check_refused(state);
}

TEST_CASE("a contact between grains that are far apart is refused") {
  State state = two_grains();
  state.step = 1;
  state.contacts.push_back({.name = {no_wall, 0, 1}});
  check_refused(state);
}

TEST_CASE("a contact with a wall that is not near is refused") {
  State state = two_grains();
  add_walls(state, 10);
  state.step = 1;
  state.contacts.push_back({.name = {0, 0, 0}});
  check_refused(state);
}

TEST_CASE("a grain that leaves through a missing wall is reported lost") {
  State state = two_grains();
  state.grains.u[1].x = state.box.fixed_x(20.0 * state.time_step);  // 20 m/s
  // From 6 mm it takes 0.7 ms to x = 2 width; it may go unnoticed for half a skin.
  CHECK(failure(state, 690) == "no failure");
  CHECK_THAT(failure(state, 720), Contains("grain 1") && Contains("left"));
}

TEST_CASE("a grain that leaves to the left is reported lost") {
  State state = two_grains();
  state.grains.u[0].x = state.box.fixed_x(-20.0 * state.time_step);
  CHECK_THAT(failure(state, 700), Contains("grain 0") && Contains("left"));
}

TEST_CASE("a grain that starts beyond the space is reported lost") {
  State state = two_grains();
  add_grain(state, grain(35e-3, 3e-3, 0.0, 0.0));
  add_grain(state, grain(-35e-3, 3e-3, 0.0, 0.0));
  CHECK_THAT(failure(state, 1), Contains("left"));
}

TEST_CASE("grains outside the walls but within the space go on") {
  State state = two_grains();
  add_walls(state, 10);
  add_grain(state, grain(-2e-3, 3e-3, 0.0, 1.0));
  add_grain(state, grain(12e-3, 3e-3, 0.0, 1.0));
  CHECK(failure(state, 100) == "no failure");
}

TEST_CASE("two grains in the very same place are reported, not turned into numbers") {
  State state = two_grains();
  add_grain(state, grain(6e-3, 6e-3, 0.0, 0.0));
  const int threads = GENERATE(1, 2);
  const Stepping stepping = GENERATE(Stepping::plain, Stepping::windows);
  CHECK_THAT(failure(state, 10, threads, stepping),
             Contains("grain 1 and grain 2") && Contains("not finite") && Contains("step 1"));
}

TEST_CASE("of several forces that are not finite the first by name is reported, by any way") {
  State state = empty_box(20e-3, 20e-3);
  add_walls(state, 20);
  for (int i = 0; i < 16; ++i) add_grain(state, grain(3e-3, 1e-3 + 2.2e-3 * (i % 8), 0.0, 0.0));
  add_grain(state, grain(0.0, 0.0, 0.0, 0.0));
  state = shuffled(std::move(state), GENERATE(1u, 2u, 3u));
  for (const Stepping stepping : {Stepping::plain, Stepping::windows})
    for (const int threads : {1, 2, 4}) {
      CAPTURE(threads, stepping == Stepping::plain);
      CHECK_THAT(failure(state, 10, threads, stepping), Contains("between grain 0 and grain 8"));
    }
}

TEST_CASE("a grain in the very place of a wall grain is reported") {
  State state = two_grains();
  add_walls(state, 10);
  add_grain(state, grain(0.0, 0.0, 0.0, 0.0));
  CHECK_THAT(failure(state, 10), Contains("grain 2 and grain 0 of wall 0"));
}

TEST_CASE("a force beyond all bounds is reported") {
  State state = two_grains();
  add_grain(state, grain(6.5e-3, 6e-3, 0.0, 0.0));
  ContactModel model = paper_model();
  model.normal = LinearLaw{GENERATE(1e300, std::numeric_limits<double>::infinity()), 0.0};
  Simulation simulation(state, model, 1);
  CHECK_THROWS_AS(simulation.advance(10), RunFailure);
}

TEST_CASE("the state of a run that failed has nothing in it that is no number") {
  State state = empty_box(10e-3, 10e-3);
  state.grains.inertia = GENERATE(0.0, disc);
  for (int i = 0; i < 2; ++i) add_grain(state, grain(6e-3, 6e-3, 0.0, 0.0));
  const ContactModel model = state.grains.rotate() ? rolling_model() : paper_model();
  Simulation simulation(state, model, 1, GENERATE(Stepping::plain, Stepping::windows));
  CHECK_THROWS_AS(simulation.advance(5), RunFailure);
  const State& end = simulation.state();
  REQUIRE(end.contacts.size() == 1);
  const Contact& contact = end.contacts.front();
  CHECK(std::isfinite(contact.elastic_energy));
  CHECK(std::isfinite(contact.friction_x));
  CHECK(std::isfinite(contact.end));
  CHECK(std::isfinite(observe(end).energies.residual));
  CHECK(end.grains.kick == state.grains.kick);
}

TEST_CASE("a failed run stays failed") {
  State state = two_grains();
  add_grain(state, grain(6e-3, 6e-3, 0.0, 0.0));
  Simulation simulation(state, paper_model(), 1);
  CHECK_THROWS_AS(simulation.advance(5), RunFailure);
  CHECK_THROWS_AS(simulation.advance(5), RunFailure);
  CHECK(simulation.state().step == 1);
}

TEST_CASE("a run that was refused threads goes on when it has them again") {
  const State start = small_tube(41);
  Simulation simulation(start, paper_model(), 2, Stepping::automatic);
  simulation.advance(64);
  bool refused = false;
#pragma omp parallel num_threads(2)
#pragma omp single
  try {  // a thread of a team that has no more to give, when another way of stepping is to be tried
    simulation.advance(64);
  } catch (const RunFailure&) {
    refused = true;
  }
  CHECK(refused);
  simulation.advance(64);
  REQUIRE(simulation.state().step == 128);
  CHECK(state_hash(simulation.state()) == state_hash(advanced(start, paper_model(), 128)));
}
