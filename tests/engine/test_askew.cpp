// Slices that go askew, each some steps ahead of the next, in plain stepping and in flights: the
// same bits, and no contact missed by grains that go farther meanwhile than anybody expects.
#include "engine/askew.hpp"
#include "engine/flights.hpp"
#include "engine/simulation.hpp"
#include "engine/stepper.hpp"
#include "tests/catch.hpp"
#include "tests/engine/same_states.hpp"
#include "tests/engine/systems.hpp"

#include <numbers>
#include <stdexcept>
#include <string>

using namespace systems;
using Catch::Matchers::Contains;
using same_states::same;

namespace {

/// Of some 40 grains.
constexpr Askew small_slices{
    .bytes_of_slice = 4e3, .steps = 8, .least_bytes = 0.0, .contacts_per_grain = 0.0};

State askew(const State& state, const ContactModel& model, std::int64_t steps, int threads,
            const Askew& how = small_slices, Stepping stepping = Stepping::plain) {
  Askew of_as_many_grains = how;
  if (stepping == Stepping::windows)
    of_as_many_grains.bytes_of_slice *= 0.5;  // flights have larger ones
  Simulation simulation(state, model, threads, stepping, of_as_many_grains);
  simulation.advance(steps);
  return simulation.state();
}

/// Steps from the start of `state` that can be done without another look.
std::int64_t steps_ready(State state, std::size_t slices) {
  Candidates candidates(state, CappedSlip{}, 1, Candidates::plain_stepping, slices);
  PackedPositions coarse;
  coarse.copy_all(candidates.when_sorted());
  return candidates.ready_for(state, coarse, candidates.share(0), state.step, small_slices.steps);
}

/// With gravity at an angle.
State long_tube(double polydispersity, double inertia = 0.0) {
  State state = corrugated_tube(81, {.length = 120e-3,
                                     .wall_grains = 100,
                                     .grains = 400,
                                     .speed = 2.0,
                                     .polydispersity = polydispersity,
                                     .inertia = inertia});
  state.gravity.x = 1.0;
  return state;
}

constexpr double diameter = 2.0 * radius;
constexpr double skin = Candidates::plain_stepping.skin_per_diameter * diameter;
constexpr double skin_of_flights = Flights::purpose.skin_per_diameter * diameter;
constexpr std::int64_t groups = 61;  // of three grains, so that some are shared by two slices

State at_rest() {
  State state = empty_box(10e-3, static_cast<double>(groups) * 5e-3);
  add_walls(state, groups * 10);
  return state;
}

/// Pairs that overlap and fly apart: towards a third grain and a wall that are no candidates.
/// `overlap` in diameters.
State springs_across(double overlap, double beyond_skin = skin) {
  State state = at_rest();
  Dice dice(82);
  for (std::int64_t group = 0; group < groups; ++group) {
    const double y = static_cast<double>(group) * 5e-3;
    const double first = wall_radius + radius + dice.between(0.5, 0.8) * beyond_skin;
    const double second = first + (1.0 - overlap) * diameter;
    const double third = second + diameter + dice.between(1.01, 1.3) * beyond_skin;
    for (const double x : {first, second, third}) add_grain(state, grain(x, y, 0.0, 0.0));
  }
  return state;
}

/// The same along the tube, where the third grain may be in another slice, on either side.
State springs_along(double overlap, double side, double beyond_skin = skin) {
  State state = at_rest();
  for (std::int64_t group = 0; group < groups; ++group) {
    const double first = static_cast<double>(group) * 5e-3;
    const double second = first + side * (diameter + 1.02 * beyond_skin);
    const double third = second + side * (1.0 - overlap) * diameter;
    for (const double y : {first, second, third}) add_grain(state, grain(5e-3, y, 0.0, 0.0));
  }
  return state;
}

/// With a collision of some three steps.
ContactModel hard_model() {
  return {LinearLaw{0.5 * mass / (time_step * time_step), 0.0}, CappedSlip{}, friction,
          Attraction::keep};
}

/// A force that does not depend on the overlap.
struct Blow {
  double force;

  double elastic(double) const { return force; }
  static double damping(double, double, double) { return 0.0; }
  double stored_energy(double xi) const { return force * xi; }
  ElasticLine elastic_line() const { return {force, 0.0}; }
};

/// A contact of a step or two in which grains get a speed of a tenth of a diameter per step.
ContactModel blow_model() {
  return {OuterLaw(Blow{0.1 * diameter * mass / (time_step * time_step)}), CappedSlip{}, 0.0,
          Attraction::keep};
}

/// Two grains that come together slowly, to be blown apart, across the tube or along it.
void add_blow(State& state, double x, double y, bool across) {
  const double way = 0.5 * diameter * 1.02, speed = 0.006 * diameter / time_step;
  for (const double side : {-1.0, 1.0})
    if (across)
      add_grain(state, grain(x + side * way, y, -side * speed, 0.0));
    else
      add_grain(state, grain(x, y + side * way, 0.0, -side * speed));
}

/// Slices of some 20 grains.
constexpr Askew long_lead{
    .bytes_of_slice = 2e3, .steps = 16, .least_bytes = 0.0, .contacts_per_grain = 0.0};

State blows(bool across) {
  State state = at_rest();
  for (std::int64_t group = 0; group < groups; ++group)
    add_blow(state, 5e-3, static_cast<double>(group) * 5e-3, across);
  return state;
}

}  // namespace

TEST_CASE("slices go askew without a look only where grains have room for all steps") {
  State tube = long_tube(0.1);
  const std::size_t slices = small_slices.slices_per_thread(tube, 1, false);
  Candidates candidates(tube, CappedSlip{}, 1, Candidates::plain_stepping, slices);
  const auto ahead = [&](std::int64_t step) {
    return candidates.steps_ahead(step, small_slices.steps);
  };
  CHECK(ahead(1) == small_slices.steps);

  const std::int64_t last = candidates.hold_until();
  CHECK(ahead(last - 2) == 3);
  CHECK(ahead(last) == 1);
  CHECK(ahead(last + 1) == 0);

  // Twice as fast after the first step: 1 + 2 (steps - 1) times as far as the fastest goes in one.
  const double way = (2.0 * static_cast<double>(small_slices.steps) - 1.0) * candidates.fastest();
  const double in_case = 0.1 * 0.5 * candidates.skin();
  double& gone = candidates.slices()[1].gone;
  gone = 0.5 * candidates.skin() - in_case - 1.001 * way;
  CHECK(ahead(1) == small_slices.steps);
  gone = 0.5 * candidates.skin() - in_case - 0.999 * way;
  CHECK(ahead(1) == 0);

  Candidates in_one(tube, CappedSlip{}, 1, Candidates::plain_stepping, 1);
  CHECK(in_one.steps_ahead(1, small_slices.steps) == 1);
}

TEST_CASE("slices of a long tube go ahead of each other") {
  for (const double polydispersity : {0.0, 0.1, 0.2}) {
    const State tube = long_tube(polydispersity);
    const std::size_t slices = small_slices.slices_per_thread(tube, 1, false);
    CHECK(slices >= 6);
    CHECK(steps_ready(tube, slices) == small_slices.steps);
    CHECK(steps_ready(advanced(tube, paper_model(), 600), slices) > 2);
  }
  for (const State& state : {springs_across(0.2), springs_along(0.2, 1.0)})
    CHECK(steps_ready(state, small_slices.slices_per_thread(state, 1, false))
          == small_slices.steps);
  for (const State& state : {blows(false), blows(true)})
    CHECK(long_lead.slices_per_thread(state, 2, false) >= 2);
}

TEST_CASE("slices do each step together where pairs may be of slices that are no neighbours") {
  CHECK(steps_ready(long_tube(0.1), 1) == 1);
  CHECK(steps_ready(long_tube(0.1), 2) == 1);
  CHECK(steps_ready(long_tube(0.1), 12) == small_slices.steps);
  CHECK(steps_ready(long_tube(0.1), 14) == 1);  // one of them has too few rows of cells
  CHECK(steps_ready(long_tube(0.1), 40) == 1);  // none has more than three
}

TEST_CASE("slices without memory or steps are refused") {
  const State tube = long_tube(0.1);
  CHECK_THROWS_AS(
      askew(tube, paper_model(), 1, 1, {.bytes_of_slice = 0.0, .steps = 8, .least_bytes = 0.0}),
      std::invalid_argument);
  CHECK_THROWS_AS(
      askew(tube, paper_model(), 1, 1, {.bytes_of_slice = 4e3, .steps = 0, .least_bytes = 0.0}),
      std::invalid_argument);
}

TEST_CASE("each thread has one slice where slices could not go askew") {
  const State tube = long_tube(0.1);
  CHECK(Askew{}.slices_per_thread(tube, 1, false) == 1);  // so few grains
  CHECK(Askew{}.most_steps(tube) == 1);  // also where many threads have a slice each
  CHECK(small_slices.most_steps(tube) == small_slices.steps);
  CHECK(small_slices.slices_per_thread(small_tube(31), 1, false) == 1);
  State wide = tube;
  wide.box.length = 30.0 * diameter;
  CHECK(small_slices.slices_per_thread(wide, 1, false) == 1);
}

TEST_CASE("slices go askew sooner, and are of fewer grains, where grains are close together") {
  const State dense = long_tube(0.1);
  State dilute = dense;
  dilute.box.length *= 10.0;
  const auto grains = static_cast<double>(dense.grains.size());
  constexpr Askew large_slices{.bytes_of_slice = 10e3, .least_bytes = 0.0};
  CHECK(large_slices.slices_per_thread(dense, 1, false)
        > large_slices.slices_per_thread(dilute, 1, false));
  CHECK(large_slices.slices_per_thread(dense, 1, true)
        == large_slices.slices_per_thread(dense, 1, false) / 2);
  CHECK(Askew{.least_bytes = 120.0 * grains}.pays(dense));
  CHECK_FALSE(Askew{.least_bytes = 120.0 * grains}.pays(dilute));
  CHECK(Askew{.least_bytes = 100.0 * grains}.pays(dilute));
  CHECK_FALSE(Askew::never().pays(dense));
}

TEST_CASE("slices without neighbours in time go together with the same bits") {
  // All grains at one place of a long box: most slices have few rows.
  State start = empty_box(12e-3, 400e-3);
  Dice dice(83);
  throw_grains(start, 200,
               {.left = 0.0, .right = 12e-3, .low = 100e-3, .high = 125e-3, .speed = 3.0}, dice);
  constexpr Askew tiny_slices{
      .bytes_of_slice = 600.0, .steps = 8, .least_bytes = 0.0, .contacts_per_grain = 0.0};
  REQUIRE(tiny_slices.slices_per_thread(start, 1, false) > 25);
  REQUIRE(steps_ready(start, tiny_slices.slices_per_thread(start, 1, false)) == 1);
  const State expected = advanced(start, paper_model(), 500, 1, Stepping::plain);
  REQUIRE(expected.tally.grains.begun > 50);
  const int threads = GENERATE(1, 2);
  const Stepping stepping = GENERATE(Stepping::plain, Stepping::windows);
  CHECK(same(askew(start, paper_model(), 500, threads, tiny_slices, stepping), expected));
}

TEST_CASE("flights go askew while they have contacts enough") {
  constexpr Askew with_contacts{
      .bytes_of_slice = 4e3, .steps = 8, .least_bytes = 0.0, .contacts_per_grain = 0.1};
  CHECK_FALSE(with_contacts.flights_gain(39, 400, false));
  CHECK(with_contacts.flights_gain(40, 400, false));
  CHECK(with_contacts.flights_gain(24, 400, true));  // with somewhat fewer, if they do already
  CHECK_FALSE(with_contacts.flights_gain(23, 400, true));
}

TEST_CASE("flights stop, at a whole step, where their contacts become many or few") {
  constexpr std::int64_t steps = 20'000;
  const int threads = GENERATE(1, 2);
  const ContactModel model = paper_model();
  const auto stopped_at = [&](State& state, double contacts, std::size_t slices) {
    const Askew how{
        .bytes_of_slice = 4e3, .steps = 8, .least_bytes = 0.0, .contacts_per_grain = contacts};
    Stepper stepper(state, model,
                    {.by_flights = true, .threads = threads, .slices_per_thread = slices}, how);
    stepper.advance(steps);
    Profile profile;
    stepper.complete_state(profile);
    return state.step;
  };
  const State start = askew(long_tube(0.1), paper_model(), 0, 1);
  State state = start;
  CHECK(stopped_at(state, 1.0, 1) == steps);  // more than there are
  state = start;
  REQUIRE(state.contacts.empty());
  constexpr double a_few = 4.0 / 400.0;
  const std::int64_t now_many = stopped_at(state, a_few, 1);
  CHECK(now_many > 0);
  REQUIRE(now_many < steps);
  CHECK(state.contacts.size() >= 3);  // one may have ended in that step
  CHECK(same(state, advanced(start, paper_model(), now_many, 1, Stepping::plain)));
  const std::int64_t now_few = stopped_at(state, a_few, 4);
  CHECK(now_few > now_many);
  REQUIRE(now_few < steps);
  CHECK(state.contacts.size() <= 3);  // one may have begun
}

TEST_CASE("a long advance by flights that now go askew and now do not comes to the same bits") {
  const int threads = GENERATE(1, 3);
  const Askew how{
      .bytes_of_slice = 4e3, .steps = 8, .least_bytes = 0.0, .contacts_per_grain = 4.0 / 400.0};
  CHECK(same(askew(long_tube(0.1), paper_model(), 6000, threads, how, Stepping::windows),
             advanced(long_tube(0.1), paper_model(), 6000, 1, Stepping::plain)));
}

TEST_CASE("slices do each step together where grains are too fast for more") {
  State state = long_tube(0.1);
  state.grains.u[7].x =
      state.box.fixed_x(0.2 * Candidates::plain_stepping.skin_per_diameter * diameter);
  CHECK(steps_ready(state, 10) == 1);
}

TEST_CASE("slices that go askew give the same bits on any number of threads") {
  const State start = long_tube(0.2);
  const State expected = advanced(start, paper_model(), 600, 1, Stepping::plain);
  REQUIRE(expected.tally.grains.begun > 200);
  REQUIRE(expected.tally.walls.begun > 40);
  const int threads = GENERATE(1, 2, 3, 4);
  const Stepping stepping = GENERATE(Stepping::plain, Stepping::windows);
  CHECK(same(askew(start, paper_model(), 600, threads, small_slices, stepping), expected));
}

TEST_CASE("slices of grains that rotate go askew with the same bits") {
  const State start = long_tube(0.1, disc);
  const State expected = advanced(start, rolling_model(), 400, 1, Stepping::plain);
  const int threads = GENERATE(1, 2);
  const Stepping stepping = GENERATE(Stepping::plain, Stepping::windows);
  CHECK(same(askew(start, rolling_model(), 400, threads, small_slices, stepping), expected));
}

TEST_CASE("calls that end at any step, and any lead, give the same bits") {
  const State start = long_tube(0.0);
  const State expected = advanced(start, paper_model(), 300, 1, Stepping::plain);
  const std::int64_t lead = GENERATE(2, 3, 16);
  const Stepping stepping = GENERATE(Stepping::plain, Stepping::windows);
  Simulation simulation(
      start, paper_model(), 2, stepping,
      {.bytes_of_slice = 4e3, .steps = lead, .least_bytes = 0.0, .contacts_per_grain = 0.0});
  for (const std::int64_t steps : {1, 2, 7, 8, 9, 23, 50, 200}) simulation.advance(steps);
  CHECK(same(simulation.state(), expected));
}

TEST_CASE("strays touch grains and walls that are no candidates") {
  const double overlap = GENERATE(0.1, 0.15, 0.2);
  const State start = GENERATE_COPY(springs_across(overlap), springs_along(overlap, 1.0),
                                    springs_along(overlap, -1.0));
  const State expected = advanced(start, hard_model(), 24, 1, Stepping::plain);
  const int threads = GENERATE(1, 2);
  const Stepping stepping = GENERATE(Stepping::plain, Stepping::windows);
  CHECK(same(askew(start, hard_model(), 24, threads, small_slices, stepping), expected));
}

TEST_CASE("the strays of the test before touch somebody while slices are askew") {
  const std::int64_t steps = small_slices.steps;
  const State across = advanced(springs_across(0.2), hard_model(), steps, 1, Stepping::plain);
  CHECK(across.tally.grains.begun > groups + 5);
  CHECK(across.tally.walls.begun > 5);
  const State along = advanced(springs_along(0.2, 1.0), hard_model(), steps, 1, Stepping::plain);
  CHECK(along.tally.grains.begun == 2 * groups);
}

TEST_CASE("a grain that is thrown beyond its neighbours at once is reported lost") {
  const State start = springs_across(0.9);
  const int threads = GENERATE(1, 2);
  CHECK_THAT(failure_of([&] { askew(start, hard_model(), 24, threads); }),
             Contains("grain 2 was thrown farther") && Contains("shorter time step"));
}

TEST_CASE("a force that is not finite is told of in the step in which it was found") {
  // Two grains that hardly feel each other are in the very same place in step 3.
  const ContactModel weak{LinearLaw{1e-20, 0.0}, CappedSlip{}, 0.0, Attraction::keep};
  State start = long_tube(0.0);
  Grains& g = start.grains;
  const Fixed step = start.box.fixed_x(5e-4 * diameter);
  g.position[1].x = wrapped_difference(g.position[0].x, wrapped_product(3, step));
  g.u[1].x = wrapped_sum(g.u[0].x, step);
  g.position[1].y = g.position[0].y;
  g.u[1].y = g.u[0].y;
  const Askew how = GENERATE(Askew{}, small_slices);
  CHECK_THAT(failure_of([&] { askew(start, weak, 100, 1, how); }),
             Contains("grain 0 and grain 1 is not finite") && Contains("(step 3)"));
}

TEST_CASE("strays of flights touch grains that are candidates") {
  const bool across = GENERATE(true, false);
  State start = blows(across);
  const double close_by = (1.5 + 0.5 * Flights::purpose.skin_per_diameter + 0.01) * diameter;
  for (std::int64_t group = 0; group < groups; ++group) {
    const double y = static_cast<double>(group) * 5e-3;
    add_grain(start,
              across ? grain(5e-3 + close_by, y, 0.0, 0.0) : grain(5e-3, y + close_by, 0.0, 0.0));
  }
  const State expected = advanced(start, blow_model(), 10, 1, Stepping::plain);
  CHECK(expected.tally.grains.begun == 2 * groups);
  const int threads = GENERATE(1, 2);
  CHECK(same(askew(start, blow_model(), 10, threads, long_lead, Stepping::windows), expected));
}

TEST_CASE("strays of flights that touch somebody else end the run") {
  const int threads = GENERATE(1, 2);
  const auto failure = [&](const State& start) {
    return failure_of(
        [&] { askew(start, blow_model(), 12, threads, long_lead, Stepping::windows); });
  };
  const bool across = GENERATE(true, false);
  REQUIRE(failure(blows(across)) == "no failure");
  const double beyond = diameter * (1.5 + Flights::purpose.skin_per_diameter + 0.08);
  for (std::int64_t group = 0; group < groups; ++group)
    for (const double side : {-1.0, 1.0}) {
      State start = blows(across);
      const double y = static_cast<double>(group) * 5e-3;
      add_grain(start, across ? grain(5e-3 + side * beyond, y, 0.0, 0.0)
                              : grain(5e-3, y + side * beyond, 0.0, 0.0));
      CAPTURE(group, side);
      CHECK_THAT(failure(start), Contains("was thrown farther"));
    }
}

TEST_CASE("strays of flights that reach a wall they had not been close to end the run") {
  for (const double side : {-1.0, 1.0}) {
    State start = at_rest();
    const double to_wall =
        wall_radius + (1.5 + 0.5 * Flights::purpose.skin_per_diameter + 0.05) * diameter;
    for (std::int64_t group = 0; group < groups; ++group)
      add_blow(start, side < 0.0 ? to_wall : 10e-3 - to_wall, static_cast<double>(group) * 5e-3,
               true);
    CHECK_THAT(failure_of([&] { askew(start, blow_model(), 16, 1, long_lead, Stepping::windows); }),
               Contains("was thrown farther"));
  }
}

TEST_CASE("flights expect that squeezed grains fly apart") {
  const State start =
      GENERATE(springs_across(0.2, skin_of_flights), springs_along(0.2, 1.0, skin_of_flights));
  const State expected = advanced(start, hard_model(), 16, 1, Stepping::plain);
  CHECK(expected.tally.grains.begun > groups + 5);
  CHECK(same(askew(start, hard_model(), 16, 1, long_lead, Stepping::windows), expected));
}

TEST_CASE(
    "flights do each step together if somebody may leave the skin at twice the present speeds") {
  State start = blows(true);
  const double beyond = diameter * (1.5 + Flights::purpose.skin_per_diameter + 0.08);
  for (std::int64_t group = 0; group < groups; ++group)
    add_grain(start, grain(5e-3 + beyond, static_cast<double>(group) * 5e-3, 0.0, 0.0));
  add_grain(start, grain(5e-3, 2.5e-3, 0.02 * diameter / time_step, 0.0));
  const State expected = advanced(start, blow_model(), 14, 1, Stepping::plain);
  CHECK(expected.tally.grains.begun == 2 * groups);
  CHECK(same(askew(start, blow_model(), 14, 1, long_lead, Stepping::windows), expected));
}

TEST_CASE("flights expect that a wall that shakes throws grains farther than they are fast") {
  State start = at_rest();
  const double to_grain = wall_radius + radius + 0.1 * diameter;
  const double to_other = to_grain + (1.05 + Flights::purpose.skin_per_diameter) * diameter;
  for (std::int64_t group = 0; group < groups; ++group)
    for (const double x : {to_grain, to_other})
      add_grain(start, grain(x, static_cast<double>(group) * 5e-3, 0.0, 0.0));
  // A twentieth of a diameter per step, for much longer than slices are askew.
  const double period = 200.0 * time_step;
  start.walls[0].motion = {.amplitude_x = 0.05 * diameter * 200.0 / (2.0 * std::numbers::pi),
                           .frequency = 1.0 / period};
  const State expected = advanced(start, hard_model(), 16, 1, Stepping::plain);
  CHECK(expected.tally.walls.begun >= groups);
  CHECK(expected.tally.grains.begun >= groups);
  CHECK(same(askew(start, hard_model(), 16, 1, long_lead, Stepping::windows), expected));
}

TEST_CASE("strays of flights that go beyond their neighbours end the run, whoever is there") {
  ContactModel strong = blow_model();
  strong.normal = OuterLaw(Blow{0.3 * diameter * mass / (time_step * time_step)});
  const std::int64_t steps = GENERATE(5, 14);
  const std::string failure =
      failure_of([&] { askew(blows(true), strong, steps, 1, long_lead, Stepping::windows); });
  if (steps == 5)
    CHECK(failure == "no failure");
  else
    CHECK_THAT(failure, Contains("was thrown farther"));
}
