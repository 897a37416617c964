// The tube in parts, each stepped by a thread of its own for many steps: the same bits, also where
// news comes through the margins.
#include "engine/part.hpp"
#include "engine/parts.hpp"
#include "engine/simulation.hpp"
#include "engine/wall_watch.hpp"
#include "tests/catch.hpp"
#include "tests/engine/same_states.hpp"
#include "tests/engine/systems.hpp"

#include <algorithm>
#include <cmath>

using namespace systems;
using same_states::same;

namespace {

constexpr double diameter = 2.0 * radius;

State long_tube(double polydispersity = 0.0, double inertia = 0.0) {
  return corrugated_tube(91, {.length = 180e-3,
                              .wall_grains = 150,
                              .grains = 600,
                              .speed = 2.0,
                              .polydispersity = polydispersity,
                              .inertia = inertia});
}

State apart(const State& state, const ContactModel& model, std::int64_t steps, int threads,
            Stepping stepping) {
  Simulation simulation(state, model, threads, stepping, {}, Sharing::apart);
  simulation.advance(steps);
  return simulation.state();
}

/// A run by parts, and how its stretches went.
struct Run {
  State state;
  std::int64_t stretches, in_vain;
};

Run in_stretches(State state, const ContactModel& model, std::int64_t steps, int threads,
                 bool by_flights, Parts::Habits habits) {
  state.origin = origin_of(state);
  Run run{.state = std::move(state), .stretches = 0, .in_vain = 0};
  Parts parts(run.state, model, by_flights, threads, habits);
  Profile profile;
  parts.advance(steps, profile);
  WallWatch(run.state, model).look(run.state);
  run.stretches = parts.stretches();
  run.in_vain = parts.in_vain();
  return run;
}

/// A row of grains in touch along the whole tube, and one that hits it.
State chain() {
  constexpr std::int64_t grains = 120;
  State state = empty_box(10e-3, static_cast<double>(grains) * diameter * 1.2);
  for (std::int64_t i = 0; i < grains; ++i)
    add_grain(state, grain(5e-3, static_cast<double>(i) * diameter * 0.999, 0.0, 0.0));
  add_grain(state, grain(5e-3, static_cast<double>(grains + 3) * diameter, 0.0, -5.0));
  return state;
}

}  // namespace

TEST_CASE("parts come to the same bits as the whole") {
  const int threads = GENERATE(2, 3, 4);
  const bool flights = GENERATE(false, true);
  const Stepping stepping = flights ? Stepping::windows : Stepping::plain;
  const double inertia = GENERATE(0.0, 0.5);
  const State start = long_tube(GENERATE(0.0, 0.3), inertia);
  const ContactModel model = inertia > 0.0 ? rolling_model() : paper_model();
  const State expected = advanced(start, model, 1500, 1, Stepping::plain);
  REQUIRE(expected.tally.grains.ended > 100);
  REQUIRE(expected.tally.walls.ended > 50);
  CHECK(same(apart(start, model, 1500, threads, stepping), expected));
}

TEST_CASE("parts come to the same bits with gravity across the tube and walls that move") {
  State start = long_tube(0.2);
  start.gravity.x = 3.0;
  start.walls[0].motion = {.velocity = 0.3, .amplitude_x = 1e-4, .frequency = 400.0};
  const Stepping stepping = GENERATE(Stepping::plain, Stepping::windows);
  CHECK(same(apart(start, paper_model(), 1500, 2, stepping),
             advanced(start, paper_model(), 1500, 1, Stepping::plain)));
}

TEST_CASE("parts of a run in pieces, in any order of the slots, come to the same bits") {
  const State start = long_tube();
  const Stepping stepping = GENERATE(Stepping::plain, Stepping::windows);
  Simulation simulation(shuffled(start, 5), paper_model(), 2, stepping, {}, Sharing::apart);
  Dice dice(92);
  while (simulation.state().step < 1000)
    simulation.advance(std::min(dice.below(90), 1000 - simulation.state().step));
  CHECK(same(simulation.state(), advanced(start, paper_model(), 1000, 1, Stepping::plain)));
}

TEST_CASE("parts of a run in very many short pieces go on") {
  // Longer and longer stretches are tried; short ones must not be taken for a success of these.
  constexpr std::int64_t steps = 3, pieces = 2500;
  const State start = corrugated_tube(91, {.length = 180e-3,
                                           .wall_grains = 150,
                                           .grains = 60,
                                           .speed = 0.01,
                                           .polydispersity = 0.0,
                                           .inertia = 0.0});
  Simulation simulation(start, paper_model(), 2, Stepping::plain, {}, Sharing::apart);
  for (std::int64_t i = 1; i <= pieces; ++i) {
    simulation.advance(steps);
    REQUIRE(simulation.state().step == i * steps);
  }
  CHECK(
      same(simulation.state(), advanced(start, paper_model(), steps * pieces, 1, Stepping::plain)));
}

TEST_CASE("no grain belongs to a part without length") {
  const Fixed y = GENERATE(Fixed{0}, Fixed{1} << 40, -(Fixed{1} << 52));
  const auto begin = static_cast<std::uint64_t>(y);
  CHECK(Extent{.begin = begin, .length = 0, .margin = 0}.distance(y) == 1);
  CHECK(Extent{.begin = begin, .length = 1, .margin = 0}.distance(y) == 0);
  CHECK(Extent{.begin = begin - 1, .length = 1, .margin = 0}.distance(y) == 1);
}

TEST_CASE("all grains in rows upon each other: some parts are empty") {
  // All of them in one part of the 4096 of which the borders are made.
  State start = empty_box(20e-3, 4.096);
  for (const double y : {5.1e-3, 5.95e-3})
    for (int i = 0; i < 10; ++i) add_grain(start, grain((2.0 + 1.5 * i) * 1e-3, y, 0.01 * i, 0.0));
  const int threads = GENERATE(2, 3, 4);
  const Stepping stepping = GENERATE(Stepping::plain, Stepping::windows);
  CHECK(same(apart(start, paper_model(), 300, threads, stepping),
             advanced(start, paper_model(), 300, 1, Stepping::plain)));
}

TEST_CASE("few grains begin on one thread or apart, many on all threads together") {
  const auto first_way = [](const State& state, Stepping stepping) {
    return Simulation(state, paper_model(), 2, stepping).preferred_way();
  };
  const State few = long_tube();
  const State many = corrugated_tube(91, {.length = 1200e-3,
                                          .wall_grains = 1000,
                                          .grains = 4000,
                                          .speed = 2.0,
                                          .polydispersity = 0.0,
                                          .inertia = 0.0});
  CHECK(first_way(few, Stepping::automatic).threads == 1);
  CHECK(first_way(few, Stepping::windows) == Way{.by_flights = true, .threads = 2, .apart = true});
  for (const Stepping stepping : {Stepping::automatic, Stepping::plain}) {
    const Way way = first_way(many, stepping);
    CHECK(way.threads == 2);
    CHECK_FALSE(way.apart);
  }
}

TEST_CASE("a tube shorter than the margins is no trouble") {
  const State start = small_tube(93);
  const Stepping stepping = GENERATE(Stepping::plain, Stepping::windows);
  CHECK(same(apart(start, paper_model(), 600, GENERATE(2, 4), stepping),
             advanced(start, paper_model(), 600, 1, Stepping::plain)));
}

TEST_CASE("a grain just where a part ends belongs to the next one alone") {
  constexpr std::int64_t grains = 64;
  State state = empty_box(20e-3, 128e-3);
  state.walls.push_back(WallLattice::smooth_at(20e-3));
  for (std::int64_t i = 0; i < grains; ++i)
    add_grain(state, grain(20e-3 - 0.999 * radius, static_cast<double>(i) * 2e-3, 0.0, 0.0));
  const Stepping stepping = GENERATE(Stepping::plain, Stepping::windows);
  const State end = apart(state, paper_model(), 10, GENERATE(2, 3, 4), stepping);
  CHECK(end.tally.walls.begun == grains);
  CHECK(same(end, advanced(state, paper_model(), 10, 1, Stepping::plain)));
}

TEST_CASE("most stretches of rapid flow are kept") {
  const bool flights = GENERATE(false, true);
  const Run run = in_stretches(long_tube(), paper_model(), 6000, 2, flights, {});
  CHECK(run.stretches > 20);
  CHECK(run.in_vain < run.stretches / 4);
}

TEST_CASE("news that comes through the margins is noticed") {
  // A blow runs along the chain by a grain in each step, as bits go.
  const bool flights = GENERATE(false, true);
  const double buffer = GENERATE(1.0, 5.0);
  const State start = chain();
  const Run run =
      in_stretches(start, paper_model(), 12'000, 2, flights, {.steps = 60.0, .buffer = buffer});
  CHECK(run.in_vain > 0);
  CHECK(run.in_vain < run.stretches);
  CHECK(same(run.state, advanced(start, paper_model(), 12'000, 1, Stepping::plain)));
}

TEST_CASE("candidates that are listed anew within a stretch are counted in") {
  // Stretches far longer than candidates hold: what grains may have met then lies beyond the
  // margins, or they have met it.
  const bool flights = GENERATE(false, true);
  const State start = long_tube();
  const Run run = in_stretches(start, paper_model(), 3000, 2, flights,
                               {.steps = 1500.0, .buffer = 1.0, .steps_known = true});
  CHECK(run.in_vain > 0);
  CHECK(same(run.state, advanced(start, paper_model(), 3000, 1, Stepping::plain)));
}

TEST_CASE("no grain wanders farther than the candidates tell") {
  // Over many listings, measured from the drift that they were given.
  const bool flights = GENERATE(false, true);
  constexpr std::int64_t steps = 1500;
  const State start = long_tube();
  const ContactModel model = paper_model();
  const Fixed drift = middle_velocity(start.grains);
  State state = start;
  Stepper stepper(state, model, {.by_flights = flights, .threads = 1, .slices_per_thread = 1},
                  Askew{});
  stepper.start_over(drift);
  stepper.advance(steps);
  const Fixed way = wrapped_sum(wrapped_product(steps, drift),
                                wrapped_product(sum_of_steps(0, steps), fall_per_step(start).y));
  const auto before = slots_by_id(start.grains), after = slots_by_id(state.grains);
  double farthest = 0.0;
  for (std::size_t id = 0; id < before.size(); ++id) {
    const Fixed x =
        wrapped_difference(state.grains.position[after[id]].x, start.grains.position[before[id]].x);
    const Fixed y =
        wrapped_difference(state.grains.position[after[id]].y, start.grains.position[before[id]].y);
    farthest = std::max(farthest, std::hypot(state.box.metres_x(x),
                                             state.box.metres_y(wrapped_difference(y, way))));
  }
  REQUIRE(stepper.candidates().sorted_at() > 0);
  REQUIRE(farthest > stepper.candidates().skin());
  CHECK(farthest <= stepper.candidates().wandered());
}

TEST_CASE("parts fail as the whole does") {
  State start = long_tube();
  start.grains.u[17].x = start.box.fixed_x(0.5 * start.box.width);  // in each step
  const Stepping stepping = GENERATE(Stepping::plain, Stepping::windows);
  Simulation simulation(start, paper_model(), 2, stepping, {}, Sharing::apart);
  const std::string words = failure_of([&] { simulation.advance(200); });
  Simulation whole(start, paper_model(), 1, stepping);
  CHECK(words == failure_of([&] { whole.advance(200); }));
  CHECK(same(simulation.state(), whole.state()));
  CHECK(words.find("has left the system") != std::string::npos);
  CHECK(failure_of([&] { simulation.advance(200); }) == words);
}

TEST_CASE("a run by parts that was refused threads goes on when it has them again") {
  const State start = long_tube();
  Simulation simulation(start, paper_model(), 2, Stepping::plain, {}, Sharing::apart);
  simulation.advance(100);
  bool refused = false;
#pragma omp parallel num_threads(2)
#pragma omp single
  try {
    simulation.advance(100);
  } catch (const RunFailure&) {
    refused = true;
  }
  CHECK(refused);
  simulation.advance(100);
  CHECK(same(simulation.state(), advanced(start, paper_model(), 200)));
}

TEST_CASE("one thread has no parts") {
  CHECK_THROWS_AS(in_stretches(long_tube(), paper_model(), 1, 1, false, {}), std::invalid_argument);
}
