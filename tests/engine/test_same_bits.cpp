// The promise: the same bits for any number of threads, any order of the slots, any split of the
// steps between calls, and for a run that was stopped and taken up again.
#include "engine/observables.hpp"
#include "engine/run_failure.hpp"
#include "engine/simulation.hpp"
#include "tests/catch.hpp"
#include "tests/engine/same_states.hpp"
#include "tests/engine/systems.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>

using namespace systems;
using same_states::same;

namespace {

constexpr std::int64_t some_steps = 600;

const State& start() {
  static const State state = small_tube(31);
  return state;
}

const State& expected() {
  static const State state = advanced(start(), paper_model(), some_steps, 1, Stepping::plain);
  return state;
}

/// One section of the test for each pair of laws; `gamma_t` (1/s) of the viscous slip.
ContactModel with_each_law(ContactModel model, double gamma_t) {
  const NormalLaw normal =
      GENERATE(NormalLaw(LinearLaw{stiffness, damping}), NormalLaw(HertzKuwabaraKonoLaw{5e5, 3.3}),
               NormalLaw(PowerLaw{2e4, 1e-2, 1.2, 0.2, 1.1}),
               NormalLaw(EqualRestitutionLaw{{stiffness, 7.0}}));
  const SlipLaw slip =
      GENERATE_COPY(SlipLaw(CappedSlip{}), SlipLaw(LiteralSlip{}), SlipLaw(ViscousSlip{gamma_t}),
                    SlipLaw(SpringSlip{700.0, 1e4}));
  model.normal = normal;
  model.slip = slip;
  return model;
}

void check_pieces(const State& state, const ContactModel& model) {
  const State whole = advanced(state, model, 300, 1, Stepping::plain);
  CHECK(same(advanced(state, model, 300, 1, Stepping::windows), whole));
  CHECK(same(advanced(state, model, 300, 2, Stepping::plain), whole));
  CHECK(same(advanced(advanced(shuffled(state, 8), model, 123), model, 177), whole));
}

}  // namespace

TEST_CASE("the expected run has something to get wrong") {
  CHECK(expected().tally.grains.begun > 20);
  CHECK(expected().tally.walls.begun > 5);
  CHECK_FALSE(expected().contacts.empty());
  CHECK(expected().tally.brakes.contacts > 5);
  CHECK_FALSE(expected().open_visits.empty());
}

TEST_CASE("states whose zeros differ in their signs are not the same") {
  State state = expected();
  state.contacts.at(0).spring = 0.0;
  State other = state;
  other.contacts[0].spring = -0.0;
  CHECK(same(state, state));
  CHECK_FALSE(same(other, state));
}

TEST_CASE("windows, automatic and plain stepping give the same bits") {
  const Stepping stepping = GENERATE(Stepping::plain, Stepping::windows, Stepping::automatic);
  CHECK(same(advanced(start(), paper_model(), some_steps, 1, stepping), expected()));
}

TEST_CASE("a run that changes its stepping on the way has the same bits") {
  // A clump, in which all grains touch, flies apart.
  State state = empty_box(20e-3, 30e-3);
  Dice dice(72);
  throw_grains(state, 40, {.left = 6e-3, .right = 14e-3, .low = 11e-3, .high = 19e-3, .speed = 2.0},
               dice);
  const std::int64_t steps = 3000;
  const int threads = GENERATE(1, 2);
  Simulation simulation(state, paper_model(), threads, Stepping::automatic);
  while (simulation.state().step < steps) simulation.advance(100);
  CHECK(same(simulation.state(), advanced(state, paper_model(), steps, 1, Stepping::plain)));
}

TEST_CASE("several threads give the same bits for any order of the slots") {
  const auto seed = GENERATE(as<std::uint64_t>{}, 1, 2, 3);
  const Stepping stepping = GENERATE(Stepping::plain, Stepping::windows);
  CHECK(
      same(advanced(shuffled(start(), seed), paper_model(), some_steps, 2, stepping), expected()));
}

TEST_CASE("several threads give the same bits for any split of the steps") {
  const Stepping stepping = GENERATE(Stepping::plain, Stepping::windows);
  Simulation simulation(start(), paper_model(), 3, stepping);
  Dice dice(35);
  while (simulation.state().step < some_steps)
    simulation.advance(std::min(dice.below(60), some_steps - simulation.state().step));
  CHECK(same(simulation.state(), expected()));
}

TEST_CASE("two runs are the same") {
  CHECK(same(advanced(start(), paper_model(), some_steps), expected()));
}

TEST_CASE("any number of threads gives the same bits") {
  const int threads = GENERATE(1, 2, 3, 4);
  const Stepping stepping = GENERATE(Stepping::plain, Stepping::windows);
  CHECK(same(advanced(start(), paper_model(), some_steps, threads, stepping), expected()));
}

TEST_CASE("more threads than grains give the same bits") {
  const State few = small_tube(32, 3);
  const Stepping stepping = GENERATE(Stepping::plain, Stepping::windows);
  CHECK(same(advanced(few, paper_model(), 100, 4, stepping), advanced(few, paper_model(), 100)));
}

TEST_CASE("a step by several threads is not begun before the last one is known") {
  // Each call begins a new team, whose threads must agree on the number of the first step.
  const Stepping stepping = GENERATE(Stepping::plain, Stepping::windows);
  Simulation simulation(start(), paper_model(), 2, stepping);
  for (int i = 0; i < 100; ++i) simulation.advance(1);
  CHECK(same(simulation.state(), advanced(start(), paper_model(), 100)));
}

TEST_CASE("a team smaller than asked for never goes unnoticed") {
  // Inside a parallel region OpenMP grants one thread. A run that begins there makes do with it;
  // one that has two is refused. No grains are left standing.
  const State reference = advanced(start(), paper_model(), 50);
  const Stepping stepping = GENERATE(Stepping::plain, Stepping::windows);
  Simulation of_two(start(), paper_model(), 2, stepping, {}, Sharing::together);
  REQUIRE(of_two.threads() == 2);
  int granted = 0;
  bool right = false, refused = false;
#pragma omp parallel num_threads(2)
#pragma omp single
  {
    const auto goes_on = [](const auto& run) { return failure_of(run) == "no failure"; };
    right = goes_on([&] {
      Simulation of_one(start(), paper_model(), 2, stepping, {}, Sharing::together);
      granted = of_one.threads();
      of_one.advance(50);
      if (!same(of_one.state(), reference)) throw RunFailure("other bits");
    });
    refused = !goes_on([&] { of_two.advance(50); });
  }
  CHECK(granted == 1);
  CHECK(right);
  CHECK(refused);
  CHECK(of_two.state().step == 0);
}

TEST_CASE("any split of the steps gives the same bits") {
  const Stepping stepping = GENERATE(Stepping::plain, Stepping::windows, Stepping::automatic);
  Simulation simulation(start(), paper_model(), 1, stepping);
  SECTION("one by one") {
    for (std::int64_t i = 0; i < some_steps; ++i) simulation.advance(1);
  }
  SECTION("nothing is a split too, and less is nothing") {
    for (const std::int64_t none : {0, -7}) simulation.advance(none);
    simulation.advance(100);
    for (const std::int64_t none : {-70, 0, -1000}) simulation.advance(none);
    CHECK(simulation.state().step == 100);
    simulation.advance(some_steps - 100);
    for (const std::int64_t none : {0, -1}) simulation.advance(none);
  }
  SECTION("at random") {
    Dice dice(33);
    while (simulation.state().step < some_steps)
      simulation.advance(std::min(dice.below(60), some_steps - simulation.state().step));
  }
  CHECK(same(simulation.state(), expected()));
}

TEST_CASE("looking at a run does not change it") {
  Simulation simulation(start(), paper_model(), 1);
  for (std::int64_t i = 0; i < some_steps; i += 50) {
    simulation.advance(50);
    (void)observe(simulation.state());
    (void)state_hash(simulation.state());
  }
  CHECK(same(simulation.state(), expected()));
}

TEST_CASE("any order of the slots gives the same bits") {
  const auto seed = GENERATE(as<std::uint64_t>{}, 1, 2, 3, 4, 5);
  const Stepping stepping = GENERATE(Stepping::plain, Stepping::windows);
  CHECK(
      same(advanced(shuffled(start(), seed), paper_model(), some_steps, 1, stepping), expected()));
}

TEST_CASE("nothing has no sign, whichever grain of a contact is the first") {
  // At rest and struck head on, so that there is no slip and no force along one axis.
  State head_on = empty_box(8e-3, 20e-3);
  add_grain(head_on, grain(3.01e-3, 5e-3, 0.0, 0.0));
  add_grain(head_on, grain(2e-3, 5e-3, 1.0, 0.0));
  for (const double x : {0.6e-3, 7.4e-3}) add_grain(head_on, grain(x, 15e-3, 0.0, 0.0));
  const State plain = advanced(head_on, paper_model(), 30, 1, Stepping::plain);
  const State windows = advanced(head_on, paper_model(), 30, 1, Stepping::windows);
  REQUIRE(plain.contacts.size() == 1);
  CHECK(state_hash(plain) == state_hash(windows));
  CHECK_FALSE(std::signbit(plain.contacts[0].friction_x));
  CHECK_FALSE(std::signbit(plain.contacts[0].entry_slip));
}

TEST_CASE("a run taken up again at any step has the same bits") {
  Dice dice(34);
  int in_contact = 0;
  for (int i = 0; i < 20; ++i) {
    const std::int64_t stop = dice.below(some_steps), rest = some_steps - stop;
    const Stepping first = i % 2 == 0 ? Stepping::plain : Stepping::windows;
    CAPTURE(stop);
    const State middle = advanced(start(), paper_model(), stop, 1, first);
    in_contact += !middle.contacts.empty();
    for (const Stepping then : {Stepping::plain, Stepping::windows}) {
      CHECK(same(advanced(middle, paper_model(), rest, 1, then), expected()));
      CHECK(same(advanced(shuffled(middle, 7), paper_model(), rest, 1, then), expected()));
    }
  }
  CHECK(in_contact > 10);
}

TEST_CASE("a run taken up again with another number of threads has the same bits") {
  const Stepping stepping = GENERATE(Stepping::plain, Stepping::windows);
  Dice dice(36);
  for (int i = 0; i < 10; ++i) {
    const std::int64_t stop = dice.below(some_steps);
    const int first = 1 + i % 4, then = 1 + (i + 1 + i / 4) % 4;
    CAPTURE(stop, first, then);
    const State middle = advanced(shuffled(start(), 9), paper_model(), stop, first, stepping);
    CHECK(same(advanced(middle, paper_model(), some_steps - stop, then, stepping), expected()));
  }
}

TEST_CASE("a run taken up in every step has the same bits") {
  State state = start();
  for (std::int64_t i = 0; i < some_steps; ++i) state = advanced(state, paper_model(), 1);
  CHECK(same(state, expected()));
}

TEST_CASE("every law gives the same bits in pieces") {
  ContactModel model = with_each_law(paper_model(), 1e5);
  model.attraction = Attraction::clip;
  check_pieces(start(), model);
}

TEST_CASE("grains that rotate, with springs, have the same bits however they are stepped") {
  const State tube = small_tube(37, 40, disc);
  const State whole = advanced(tube, rolling_model(), some_steps, 1, Stepping::plain);
  REQUIRE(std::ranges::any_of(whole.contacts, [](const Contact& c) {
    return c.spring != 0.0 && c.torque != 0.0 && c.rolling_torque != 0.0;
  }));
  const int threads = GENERATE(1, 2, 3);
  const Stepping stepping = GENERATE(Stepping::plain, Stepping::windows);
  CHECK(same(advanced(shuffled(tube, 1), rolling_model(), some_steps, threads, stepping), whole));
  Dice dice(38);
  State state = shuffled(tube, 2);
  while (state.step < some_steps)
    state = advanced(shuffled(state, 3), rolling_model(),
                     std::min(1 + dice.below(60), some_steps - state.step), threads, stepping);
  CHECK(same(state, whole));
}

TEST_CASE("grains that rotate have the same bits under every law in pieces") {
  check_pieces(small_tube(39, 40, sphere), with_each_law(rolling_model(), 3e4));
}
