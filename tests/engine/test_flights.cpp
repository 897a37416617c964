// Crossing many steps at once: the states that would catch an appointment made too late, against
// stepping all grains in each step. The results must be equal in every bit.
#include "engine/calendar.hpp"
#include "engine/flights.hpp"
#include "engine/simulation.hpp"
#include "tests/catch.hpp"
#include "tests/engine/same_states.hpp"
#include "tests/engine/systems.hpp"

#include <cmath>
#include <numbers>

using namespace systems;
using same_states::same;

namespace {

/// Runs both ways, compares them, and returns the end. With several threads most contacts of so few
/// grains are between slices.
State same_both_ways(const State& start, std::int64_t steps, int threads = 2,
                     const ContactModel& model = paper_model()) {
  State plain = advanced(start, model, steps, 1, Stepping::plain);
  CHECK(same(advanced(start, model, steps, 1, Stepping::windows), plain));
  CAPTURE(threads);
  CHECK(same(advanced(start, model, steps, threads, Stepping::windows), plain));

  Simulation in_pieces(start, model, 1, Stepping::windows);
  Dice dice(1);
  while (in_pieces.state().step < steps)
    in_pieces.advance(std::min(dice.below(200), steps - in_pieces.state().step));
  CHECK(same(in_pieces.state(), plain));
  return plain;
}

}  // namespace

TEST_CASE("a meeting beyond the horizon of the calendar is kept") {
  // 0.15 mm apart at 0.05 m/s: 3000 steps, within the same candidates all the way.
  State state = empty_box(20e-3, 20e-3);
  add_grain(state, grain(5e-3, 5e-3, 0.0, 0.0));
  add_grain(state, grain(6.15e-3, 5e-3, -0.05, 0.0));
  static_assert(Calendar::horizon < 3000);
  CHECK(same_both_ways(state, 4000).tally.grains.begun == 1);
}

TEST_CASE("a thin gas goes both ways alike") {
  State state = empty_box(20e-3, 30e-3);
  state.gravity.y = 10.0;
  add_walls(state, 25);
  Dice dice(71);
  throw_grains(state, 40, {.left = 0.0, .right = 20e-3, .low = 0.0, .high = 30e-3, .speed = 5.0},
               dice);
  const State end = same_both_ways(state, 6000);
  CHECK(end.tally.grains.begun > 20);
  CHECK(end.tally.walls.begun > 20);
}

TEST_CASE("a heap on a slope goes both ways alike") {
  // Thrown upwards and pressed to the bottom by gravity: free flights, bounces and contacts that
  // last.
  const double angle = GENERATE(0.0, 0.4, 1.2);
  State state = empty_box(30e-3, 9.6e-3);
  state.gravity = {.x = -50.0 * std::cos(angle), .y = 50.0 * std::sin(angle)};
  state.walls = {{.line = 0.0, .radius = wall_radius, .count = 8}};
  Dice dice(73);
  throw_grains(state, 40, {.left = 0.0, .right = 12e-3, .low = 0.0, .high = 9.6e-3, .speed = 0.4},
               dice);
  const State end = same_both_ways(state, 30'000);
  CHECK(end.tally.grains.begun > 100);
  CHECK(end.tally.walls.begun > 30);
  CHECK_FALSE(end.contacts.empty());
}

TEST_CASE("a thin gas between smooth walls goes both ways alike") {
  State state = empty_box(12e-3, 20e-3);
  state.gravity.y = 10.0;
  for (const double line : {0.0, 12e-3}) state.walls.push_back(WallLattice::smooth_at(line));
  Dice dice(74);
  throw_grains(state, 30, {.left = 0.0, .right = 12e-3, .low = 0.0, .high = 20e-3, .speed = 5.0},
               dice);
  CHECK(same_both_ways(state, 6000).tally.walls.begun > 15);
}

TEST_CASE("grains that touch a plane to the last digit go both ways alike") {
  // Whether they overlap is a question of rounding, and of how it is asked.
  State state = empty_box(20e-3, 100e-3);
  state.walls.push_back(WallLattice::smooth_at(20e-3));
  for (int i = 0; i < 60; ++i) {
    Grain g = grain(0.0, i * 1.5e-3, 0.0, 1e-3 * i);
    g.radius = 0.25e-3 + 5e-6 * i;
    g.x = 20e-3 - g.radius;
    add_grain(state, g);
  }
  CHECK(same_both_ways(state, 10).tally.walls.begun > 0);
}

TEST_CASE("a thin gas between moving walls goes both ways alike") {
  State state = empty_box(12e-3, 20e-3);
  add_walls(state, 16);
  state.walls[0].motion = {.velocity = -3.0};
  state.walls[1].motion = {.velocity = 3.0, .amplitude_y = 0.5e-3, .frequency = 1000.0};
  Dice dice(75);
  throw_grains(state, 30, {.left = 0.0, .right = 12e-3, .low = 0.0, .high = 20e-3, .speed = 2.0},
               dice);
  const State end = same_both_ways(state, 10'000);
  CHECK(end.tally.walls.begun > 15);
  CHECK(end.tally.impulses.work.value() > 0.0);
}

TEST_CASE("grains that walls shaken across come to go both ways alike") {
  State state = empty_box(12e-3, 20e-3);
  SECTION("corrugated") { add_walls(state, 16); }
  SECTION("smooth") {
    for (const double line : {0.0, 12e-3}) state.walls.push_back(WallLattice::smooth_at(line));
    state.gravity.x = -10.0;
  }
  state.walls[0].motion = {.amplitude_x = 2e-3, .frequency = 200.0};
  state.walls[1].motion = {.amplitude_x = -1e-3, .amplitude_y = 1e-3, .frequency = 500.0};
  // At rest, and most of them where no wall is at first.
  Dice dice(76);
  throw_grains(state, 30, {.left = 1e-3, .right = 11e-3, .low = 0.0, .high = 20e-3, .speed = 0.0},
               dice);
  const State end = same_both_ways(state, 10'000);
  CHECK(end.tally.walls.begun > 15);
  CHECK(end.tally.impulses.work.value() > 0.0);
}

TEST_CASE("grains that fall to a wall side by side go both ways alike") {
  // As seen from each other they are at rest, so that only what is common takes them there.
  const double gap = GENERATE(1e-6, 30e-6, 0.1e-3);
  State state = empty_box(20e-3, 60e-3);
  state.gravity.x = -300.0;
  state.walls.push_back(WallLattice::smooth_at(0.0));
  for (int i = 0; i < 10; ++i) add_grain(state, grain(radius + gap, i * 5e-3, 0.0, 0.0));
  CHECK(same_both_ways(state, 3000).tally.walls.begun >= 10);
}

TEST_CASE("a grain fired along the wall goes both ways alike") {
  const double speed = GENERATE(1.0, 10.0, 60.0);
  State state = empty_box(8e-3, 9.6e-3);
  add_walls(state, 12);
  add_grain(state, grain(0.825e-3, 4e-3, 0.0, speed));
  CHECK(same_both_ways(state, 1000).tally.walls.begun > 0);
}

TEST_CASE("a grain that only gravity brings back to the wall goes both ways alike") {
  // Thrown up from above a wall grain: its path without gravity leads away for good.
  State state = empty_box(8e-3, 9.6e-3);
  state.gravity.y = 10.0;
  state.time_step = 5e-6;
  add_walls(state, 1);
  add_grain(state, grain(0.1e-3, -0.9e-3, 0.0, -0.05));
  CHECK(same_both_ways(state, 6000).tally.walls.begun > 0);
}

TEST_CASE("Newton's cradle goes both ways alike") {
  State state = empty_box(20e-3, 10e-3);
  add_grain(state, grain(2e-3, 5e-3, 3.0, 0.0));
  const double gap = GENERATE(0.0, 1e-9, 1e-6, 5e-5);
  for (int i = 0; i < 8; ++i) add_grain(state, grain(4e-3 + i * (1e-3 + gap), 5e-3, 0.0, 0.0));
  CHECK(same_both_ways(state, 2500, 3, frictionless(0.0)).tally.grains.begun >= 8);
}

TEST_CASE("grains that start overlapped go both ways alike") {
  State state = empty_box(20e-3, 20e-3);
  add_walls(state, 20);
  add_grain(state, grain(5e-3, 5e-3, 0.0, 0.0));
  add_grain(state, grain(5.9e-3, 5e-3, 0.0, 0.0));
  add_grain(state, grain(5.4e-3, 5.7e-3, 0.0, 0.0));
  add_grain(state, grain(0.75e-3, 10e-3, 0.0, 0.0));
  CHECK(same_both_ways(state, 1500).tally.grains.begun >= 3);
}

TEST_CASE("a grain struck on its way to another goes both ways alike") {
  // 0 and 1 are about to pass each other; 2 strikes 0 from the side, towards 1.
  State state = empty_box(20e-3, 20e-3);
  add_grain(state, grain(5e-3, 5e-3, 0.0, 1.0));
  add_grain(state, grain(6.05e-3, 6.5e-3, 0.0, -1.0));
  add_grain(state, grain(3.9e-3, 5.2e-3, 4.0, 1.0));
  CHECK(same_both_ways(state, 2000).tally.grains.begun >= 2);
}

TEST_CASE("a contact is kept while a third grain needs new candidates in every step") {
  // Tens of diameters per step: the candidates do not even hold in the step they are made in.
  State state = empty_box(20e-3, 0.2);
  add_grain(state, grain(15e-3, 5e-3, 0.0, 0.07 / state.time_step));
  add_grain(state, grain(3e-3, 5e-3, 1.0, 0.0));
  add_grain(state, grain(4.1e-3, 5e-3, 0.0, 0.0));
  CHECK(same_both_ways(state, 400).tally.grains.begun == 1);
}

TEST_CASE("grains that leave their courses in most steps of a contact go both ways alike") {
  // Hardly any course is kept for longer than a step: contacts take five of them, and the fastest
  // grain goes so far in one that the tolerance is as wide as it gets.
  constexpr double widest_tolerance = 0.004 * 2.0 * radius;  // m
  State state = empty_box(40e-3, 20e-3);
  state.time_step = 10.0 * time_step;
  add_grain(state, grain(3e-3, 5e-3, 6.0, 0.0));
  for (int i = 0; i < 8; ++i) add_grain(state, grain(4.1e-3 + i * 1.1e-3, 5e-3, 0.0, 0.0));
  add_grain(state, grain(8e-3, 6.2e-3, 0.0, 0.0));

  const ContactModel model = frictionless(0.0);
  Simulation plain(state, model, 1, Stepping::plain);
  int in_contact = 0, off_course = 0;
  for (int step = 0; step < 500; ++step) {
    const State before = plain.state();
    plain.advance(1);
    if (before.contacts.empty()) continue;
    ++in_contact;
    double most = 0.0;
    for (std::int32_t id = 0; id < 9; ++id)
      most = std::max(most, std::abs(grain_of_id(plain.state(), id).vx - grain_of_id(before, id).vx)
                                * state.time_step);
    off_course += most > widest_tolerance ? 1 : 0;
  }
  CHECK(in_contact > 20);
  CHECK(off_course > 0.7 * in_contact);
  CHECK(same_both_ways(state, 500, 3, model).tally.grains.begun >= 8);
}

TEST_CASE("a grain that swings in its contacts is met where it is") {
  // Wedged between two walls it swings for ever, by less than a grain in contact may be off its
  // course. A small one comes along, and all are listed anew meanwhile: the course that is set then
  // must be right, in whatever phase, as nobody corrects it.
  constexpr double wedged = 2e-6, swing = 0.25e-6, small = 0.3e-3;  // m
  constexpr int phases = 1000;
  State walls = empty_box(2.0 * (radius - wedged), 20e-3);
  walls.time_step = 2e-5;
  for (const double line : {0.0, walls.box.width})
    walls.walls.push_back(WallLattice::smooth_at(line));
  const double omega = std::sqrt(2.0 * stiffness / mass);
  int alike = 0, met = 0;
  for (int i = 0; i < phases; ++i) {
    const double phase = 2.0 * std::numbers::pi * i / phases;
    State state = walls;
    add_grain(state, grain(0.5 * state.box.width + swing * std::cos(phase), 5e-3,
                           omega * swing * std::sin(phase), 0.0));
    Grain other = grain(small + 0.02e-3, 5e-3 - 0.8e-3 - 1.45e-3, 0.0, 0.125);
    other.radius = small;
    add_grain(state, other);
    const ContactModel model = frictionless(0.0);
    const State plain = advanced(state, model, 700, 1, Stepping::plain);
    const State windows = advanced(state, model, 700, 1, Stepping::windows);
    alike += state_hash(windows) == state_hash(plain) ? 1 : 0;
    met += plain.tally.grains.begun > 0 ? 1 : 0;
  }
  CHECK(met == phases);
  CHECK(alike == phases);
}

TEST_CASE("random systems of all kinds go both ways alike") {
  for (std::uint64_t seed = 200; seed < 260; ++seed) {
    CAPTURE(seed);
    Dice dice(seed);
    const double length = dice.between(4e-3, 20e-3), width = dice.between(4e-3, 15e-3);
    State state = empty_box(width, length);
    state.gravity.y = dice.between(-20.0, 20.0);
    state.time_step = dice.between(0.3e-6, 3e-6);
    add_walls(state, 1 + dice.below(30));
    // One draw after the other: arguments of one call are evaluated in an order of the compiler's.
    const Throw where{.left = 0.0,
                      .right = state.box.width,
                      .low = 0.0,
                      .high = state.box.length,
                      .speed = std::pow(10.0, dice.between(-1.0, 1.0)),
                      .common_vy = dice.between(-20.0, 20.0),
                      .polydispersity = 0.2};
    const double room = state.box.width * state.box.length / (radius * radius);
    const auto count = static_cast<std::size_t>(dice.between(0.01, 0.07) * room);
    throw_grains(state, count, where, dice);
    // Teams take time on a busy machine: only some.
    same_both_ways(state, 1000, seed % 5 == 0 ? 2 + static_cast<int>(seed / 5 % 3) : 1);
  }
}

TEST_CASE("in a short period the listed image of a pair stays the nearest until the next listing") {
  // Each of the two may go half a skin, away from the other.
  for (const double diameters : {3.1, 4.0, 4.5, 6.0, 20.0}) {
    State state = empty_box(10e-3, diameters * 2.0 * radius);
    add_grain(state, grain(3e-3, 1e-3, 0.0, 0.0));
    add_grain(state, grain(6e-3, 2e-3, 0.0, 0.0));
    for (const Candidates::Purpose& purpose : {Flights::purpose, Candidates::plain_stepping}) {
      const Candidates candidates(state, CappedSlip{}, 1, purpose, 1);
      CAPTURE(diameters, candidates.skin());
      CHECK(candidates.skin() > 0.0);
      CHECK(2.0 * radius + 2.0 * candidates.skin() < 0.5 * state.box.length);
    }
  }
  State shorter = empty_box(10e-3, 2.9 * 2.0 * radius);
  add_grain(shorter, grain(3e-3, 1e-3, 0.0, 0.0));
  CHECK_THROWS_AS(Candidates(shorter, CappedSlip{}, 1, Flights::purpose, 1), std::invalid_argument);
}
