// The engine against a stepper that tries all pairs in every step: the same contacts in the same
// steps, and the same paths, whatever the arrangement.
//
// Tolerance: both do the same arithmetic but round differently, by about 1e-19 m per step. A
// collision magnifies a difference by about (free path / radius) ~ 10, so after the few collisions
// that a grain has in these runs 1e-9 m is generous; a single contact missed or found a step late
// shows as 1e-6 m.
#include "engine/simulation.hpp"
#include "tests/catch.hpp"
#include "tests/engine/brute_force.hpp"
#include "tests/engine/systems.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

using namespace systems;

namespace {

/// How much of interest happened while the two agreed.
struct Events {
  std::int64_t pairs_begun = 0;
  std::int64_t walls_begun = 0;
};

bool same_contacts(const State& state, const brute_force::Stepper& reference) {
  return std::equal(state.contacts.begin(), state.contacts.end(), reference.touching().begin(),
                    reference.touching().end(),
                    [](const Contact& a, const auto& b) { return a.name == b.first; });
}

/// Runs both side by side and compares them in every step.
Events agree(const State& start, std::int64_t steps, const ContactModel& model, int threads,
             Stepping stepping) {
  Simulation simulation(start, model, threads, stepping);
  brute_force::Stepper reference(start, model);
  for (std::int64_t step = 1; step <= steps; ++step) {
    simulation.advance(1);
    reference.step();
    if (!same_contacts(simulation.state(), reference))
      FAIL("other contacts than the brute force in step " << step);
  }
  CHECK(reference.distance_to(simulation.state()) < 1e-9);
  const Tally& tally = simulation.state().tally;
  return {tally.grains.begun, tally.walls.begun};
}

/// The same for all kinds of stepping on one thread. The windows are also let run without being
/// looked at, when nothing lands the flying grains in between, and by two threads.
Events agree(const State& start, std::int64_t steps, const ContactModel& model = paper_model()) {
  const Events events = agree(start, steps, model, 1, Stepping::plain);
  agree(start, steps, model, 1, Stepping::windows);
  const State plain = advanced(start, model, steps, 1, Stepping::plain);
  for (const int threads : {1, 2})
    CHECK(state_hash(advanced(start, model, steps, threads, Stepping::windows))
          == state_hash(plain));
  return events;
}

/// Random grains all over a box without walls.
State gas(double width, double length, std::size_t grains, double speed, std::uint64_t seed) {
  State state = empty_box(width, length);
  Dice dice(seed);
  throw_grains(state, grains,
               {.left = 0.0, .right = width, .low = 0.0, .high = length, .speed = speed}, dice);
  return state;
}

}  // namespace

TEST_CASE("a crowded tube of unequal grains goes as by brute force") {
  const std::uint64_t seed = GENERATE(as<std::uint64_t>{}, 1, 2, 3);
  const Events events = agree(small_tube(seed), 800);
  CHECK(events.pairs_begun > 20);
  CHECK(events.walls_begun > 5);
}

TEST_CASE("every law of the contact goes as by brute force") {
  ContactModel model = paper_model();
  SECTION("Hertz-Kuwabara-Kono") { model.normal = HertzKuwabaraKonoLaw{5e5, 3.3}; }
  SECTION("general power law") { model.normal = PowerLaw{2e4, 1e-2, 1.2, 0.2, 1.1}; }
  SECTION("equal restitution") { model.normal = EqualRestitutionLaw{{stiffness, 7.0}}; }
  SECTION("literal sign of the slip") { model.slip = LiteralSlip{}; }
  SECTION("viscous slip") { model.slip = ViscousSlip{1e5}; }
  SECTION("no attraction") { model.attraction = Attraction::clip; }
  SECTION("tangential spring") { model.slip = SpringSlip{800.0, 3e3}; }
  CHECK(agree(small_tube(4), 300, model).pairs_begun > 10);
}

TEST_CASE("grains that rotate go as by brute force") {
  ContactModel model = rolling_model();
  SECTION("spring and resistance to rolling") {}
  SECTION("capped slip") { model.slip = CappedSlip{}; }
  SECTION("literal sign of the slip") { model.slip = LiteralSlip{}; }
  SECTION("viscous slip") { model.slip = ViscousSlip{3e4}; }
  CHECK(agree(small_tube(4, 40, disc), 300, model).pairs_begun > 10);
}

TEST_CASE("grains under gravity at an angle go as by brute force") {
  // So much of it that the fall to a wall is a good part of what happens.
  const auto [x, y] =
      GENERATE(std::pair{-800.0, 0.0}, std::pair{500.0, 500.0}, std::pair{-5.0, 8.0});
  State state = small_tube(18);
  state.gravity = {.x = x, .y = y};
  const Events events = agree(state, 800);
  CHECK(events.pairs_begun > 20);
  CHECK(events.walls_begun > 5);
}

TEST_CASE("grains that gravity alone brings to a wall go as by brute force") {
  // From so far away that their candidates are listed anew on the way, and thrown against it; or so
  // slow beside each other that only their common fall asks for that.
  const bool slow = GENERATE(false, true);
  State state = empty_box(20e-3, 9.6e-3);
  state.gravity = {.x = -3000.0, .y = 0.0};
  state.walls = {{.line = 0.0, .radius = wall_radius, .count = 8}};
  Dice dice(19);
  throw_grains(
      state, 12,
      {.left = 4e-3, .right = 12e-3, .low = 0.0, .high = 9.6e-3, .speed = slow ? 0.003 : 0.3},
      dice);
  if (!slow) add_grain(state, grain(14e-3, 1e-3, 2.0, 0.0));
  CHECK(agree(state, 4000, frictionless(0.3 * damping)).walls_begun > 12);
}

TEST_CASE("a grain in the hollow at the seam of a wall goes as by brute force") {
  // It touches the last wall grain and the first, at times both.
  const auto count = GENERATE(as<std::int64_t>{}, 8, 63, 64, 65, 66, 67, 129, 193);
  const double spacing = 1.2e-3;
  State state = empty_box(8e-3, static_cast<double>(count) * spacing);
  add_walls(state, count);
  add_grain(state, grain(1e-3, -0.48 * spacing, -2.0, 0.0));
  add_grain(state, grain(2.1e-3, -0.5 * spacing, -3.0, 0.1));
  CAPTURE(count);
  CHECK(agree(state, 1500, frictionless(damping)).walls_begun >= 2);
}

TEST_CASE("grains between smooth walls go as by brute force") {
  const double inertia = GENERATE(0.0, disc);
  State state = small_tube(20, 40, inertia);
  for (WallLattice& wall : state.walls) wall = WallLattice::smooth_at(wall.line);
  state.gravity = {.x = -300.0, .y = 100.0};
  const Events events = agree(state, 800, inertia > 0.0 ? rolling_model() : paper_model());
  CHECK(events.pairs_begun > 20);
  CHECK(events.walls_begun > 5);
}

TEST_CASE("grains between walls that move go as by brute force") {
  State state = small_tube(22);
  SECTION("at constant velocity") {
    state.walls[0].motion.velocity = -6.0;
    state.walls[1].motion.velocity = 20.0;
  }
  SECTION("to and fro") {
    for (WallLattice& wall : state.walls)
      wall.motion = {.velocity = 0.5, .amplitude_y = 1e-3, .frequency = 2000.0};
  }
  SECTION("across") {
    state.walls[0].motion = {.amplitude_x = 0.8e-3, .frequency = 1500.0};
    state.walls[1].motion = {
        .amplitude_x = -0.5e-3, .amplitude_y = 0.5e-3, .frequency = 3000.0, .phase = 2.0};
  }
  SECTION("smooth ones") {
    const WallMotion motion =
        GENERATE(WallMotion{.velocity = 9.0}, WallMotion{.amplitude_x = 1e-3, .frequency = 1000.0});
    for (WallLattice& wall : state.walls)
      wall = {.line = wall.line, .radius = 0.0, .count = 0, .motion = motion};
  }
  const Events events = agree(state, 800);
  CHECK(events.pairs_begun > 20);
  CHECK(events.walls_begun > 5);
}

TEST_CASE("a wall sweeps a grain that rests beside it along") {
  // Nothing else moves: only the wall brings the two together.
  State state = empty_box(8e-3, 9.6e-3);
  add_walls(state, 4);
  state.walls[0].motion.velocity = 2.0;
  add_grain(state, grain(0.6e-3, 1.2e-3, 0.0, 0.0));
  CHECK(agree(state, 1500).walls_begun >= 1);
}

TEST_CASE("a cluster in a large box goes as by brute force") {
  State state = empty_box(40e-3, 40e-3);
  Dice dice(5);
  throw_grains(state, 30,
               {.left = 18e-3, .right = 25e-3, .low = 18e-3, .high = 25e-3, .speed = 3.0}, dice);
  throw_grains(state, 5, {.left = 0.0, .right = 40e-3, .low = 0.0, .high = 40e-3, .speed = 3.0},
               dice);
  CHECK(agree(state, 500).pairs_begun > 10);
}

TEST_CASE("a cluster astride the seam goes as by brute force") {
  State state = empty_box(10e-3, 20e-3);
  Dice dice(6);
  throw_grains(state, 30, {.left = 1e-3, .right = 9e-3, .low = -3e-3, .high = 3e-3, .speed = 3.0},
               dice);
  CHECK(agree(state, 500).pairs_begun > 10);
}

TEST_CASE("the shortest boxes go as by brute force") {
  // of two, three, four rows of cells; a shorter one is refused
  double shortest = 4.0 * radius;
  const auto accepted = [](double length) {
    try {
      const Simulation simulation(gas(12e-3, length, 1, 0.0, 0), paper_model(), 1);
    } catch (const std::invalid_argument&) {
      return false;
    }
    return true;
  };
  while (!accepted(shortest)) shortest += 0.05e-3;
  CHECK(shortest < 8.0 * radius);
  const double rows = GENERATE(2.0, 3.0, 4.0);
  const double length = 0.5 * rows * shortest;
  const auto grains = static_cast<std::size_t>(5.5e3 * length);
  CHECK(agree(gas(12e-3, length, grains, 3.0, 7), 500).pairs_begun > 5);
}

TEST_CASE("a single column of cells goes as by brute force") {
  State state = empty_box(10e-3, 40e-3);
  Dice dice(10);
  throw_grains(state, 25, {.left = 5e-3, .right = 6e-3, .low = 0.0, .high = 40e-3, .speed = 3.0},
               dice);
  CHECK(agree(state, 500).pairs_begun > 5);
}

TEST_CASE("grains of very different size go as by brute force") {
  State state = empty_box(12e-3, 16e-3);
  add_walls(state, 10);
  add_grain(state, {.x = 6e-3, .y = 15e-3, .vx = 0, .vy = 1, .radius = 2.5e-3, .mass = 25e-6});
  Dice dice(11);
  throw_grains(state, 25, {.left = 0, .right = 12e-3, .low = 0, .high = 16e-3, .speed = 3.0}, dice);
  throw_grains(
      state, 60,
      {.left = 0, .right = 12e-3, .low = 0, .high = 16e-3, .speed = 3.0, .mean_radius = 0.1e-3},
      dice);
  CHECK(agree(state, 400).pairs_begun > 20);
}

TEST_CASE("a crowded tube of grains of two sizes goes as by brute force") {
  const std::uint64_t seed = GENERATE(as<std::uint64_t>{}, 1, 2);
  State state = empty_box(10e-3, 14.4e-3);
  state.gravity.y = 10.0;
  add_walls(state, 18);
  Dice dice(seed);
  for (const auto& [grains, mean_radius] : {std::pair{5, 1e-3}, std::pair{110, 0.2e-3}})
    throw_grains(state, static_cast<std::size_t>(grains),
                 {.left = 0.0,
                  .right = 10e-3,
                  .low = 0.0,
                  .high = 14.4e-3,
                  .speed = 3.0,
                  .common_vy = 2.0,
                  .mean_radius = mean_radius},
                 dice);
  const Events events = agree(state, 500);
  CHECK(events.pairs_begun > 40);
  CHECK(events.walls_begun > 5);
}

TEST_CASE("a single grain goes as by brute force") {
  State state = empty_box(3e-3, 6.6e-3);
  add_walls(state, 10);
  add_grain(state, grain(1.5e-3, 3e-3, -2.0, 5.0));
  CHECK(agree(state, 1500).walls_begun >= 3);
}

TEST_CASE("fast intruders go as by brute force") {
  // The budget of displacement is spent in very few steps, and on the intruder alone.
  const double speed = GENERATE(20.0, 60.0, 100.0);
  CAPTURE(speed);
  State state = small_tube(12, 30);
  Dice dice(13);
  for (int i = 0; i < 3;) {
    const double across = dice.between(-10.0, 10.0), along = i % 2 == 0 ? speed : -speed;
    const Grain intruder =
        grain(dice.between(1e-3, 7e-3), dice.between(0.0, 9.6e-3), across, along);
    if (!room_for(state, intruder)) continue;
    add_grain(state, intruder);
    ++i;
  }
  CHECK(agree(state, 300).pairs_begun > 5);
}

TEST_CASE("grains that all fall at 50 m/s go as by brute force") {
  State state = empty_box(8e-3, 10e-3);
  state.gravity.y = 10.0;
  Dice dice(14);
  throw_grains(
      state, 35,
      {.left = 0.0, .right = 8e-3, .low = 0.0, .high = 10e-3, .speed = 2.0, .common_vy = 50.0},
      dice);
  CHECK(agree(state, 500).pairs_begun > 10);
}

TEST_CASE("a grain so fast that it jumps out of a contact goes as by brute force") {
  // From an overlap it is beyond the reach of the candidates one step later, wherever the step
  // falls.
  const double phase = GENERATE(range(0, 6)) / 6.0;
  State state = empty_box(20e-3, 19.8e-3);
  state.time_step = 3e-6;
  SECTION("of a free grain") {
    const double speed = 200.0;
    add_grain(state, grain(5e-3 + phase * speed * state.time_step, 10e-3, speed, 0.0));
    add_grain(state, grain(8e-3, 10.9e-3, 0.0, 0.0));
    CHECK(agree(state, 15).pairs_begun == 1);
  }
  SECTION("of a wall") {
    const double speed = 100.0;
    state.walls = {{.line = 0.0, .radius = wall_radius, .count = 1}};
    add_grain(state, grain(2.5e-3 + phase * speed * state.time_step, 0.1e-3, -speed, 0.0));
    CHECK(agree(state, 30).walls_begun == 1);
  }
}

TEST_CASE("a large grain that is pushed goes for all that lie around it") {
  // It has more neighbours than are reconsidered at a time, and those it is pushed to are among
  // them anywhere.
  const double from = GENERATE(0.0, 0.5, 1.0, 1.5) * std::numbers::pi;
  constexpr int around = 24;
  const double large = 5e-3, gap = 1.05e-5, distance = large + radius + gap;
  State state = empty_box(30e-3, 30e-3);
  add_grain(state, {15e-3, 15e-3, 0.0, 0.0, large, 20.0 * mass});
  for (int k = 0; k < around; ++k) {
    const double angle = from + 2.0 * std::numbers::pi * k / around;
    const double x = std::cos(angle), y = std::sin(angle), speed = k == 0 ? 1.0 : 0.0;
    add_grain(state, grain(15e-3 + distance * x, 15e-3 + distance * y, -speed * x, -speed * y));
  }
  CHECK(agree(state, 1000).pairs_begun > 5);
}

TEST_CASE("a contact that ends in a sorting is booked as one that ends in a step") {
  // Deep contacts of grains that cross half the skin in a step, so that some are no candidates any
  // more when they part: which of them depends on the way of stepping.
  ContactModel model = rolling_model();
  model.normal = LinearLaw{20.0, 400.0};
  State state = empty_box(20e-3, 20e-3);
  state.time_step = 1e-5;
  SECTION("springs") { model.slip = SpringSlip{15.0, 0.0}; }
  SECTION("discs that turn") {
    model.slip = CappedSlip{};
    state.grains.inertia = disc;
  }
  Dice dice(21);
  throw_grains(state, 150, {.left = 0.0, .right = 20e-3, .low = 0.0, .high = 20e-3, .speed = 40.0},
               dice);
  const State plain = advanced(state, model, 50, 1, Stepping::plain);
  CHECK(state_hash(advanced(state, model, 50, 1, Stepping::windows)) == state_hash(plain));
}

TEST_CASE("a grain just released by a contact is not thought slower than it is") {
  // The attraction at the end of a contact slows grain 1 down, perhaps in the very step in which
  // the displacements are looked at; grain 2 comes up to it at much the same speed, perhaps from
  // just beyond the candidates' reach. Of many starts some meet both conditions.
  ContactModel model = frictionless(damping);
  model.normal = LinearLaw{200.0, damping};
  Dice dice(16);
  int met = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const double speed = 3.0, oncoming = dice.between(0.15, 0.26) * speed;  // restitution 0.3
    const double gap = dice.between(0.0, 2e-4);
    const double released_at = gap / speed + 2.4e-4;
    State state = empty_box(20e-3, 10e-3);
    state.time_step = 2.4e-5;  // 10 per collision: what the attraction does in a step is large
    add_grain(state, {5e-3, 5e-3, 0.0, 0.0, radius, 100.0 * mass});
    add_grain(state, grain(6e-3 + gap, 5e-3, -speed, 0.0));
    add_grain(state, grain(7e-3 + dice.between(1.5e-4, 4.5e-4) + oncoming * released_at, 5e-3,
                           -oncoming, 0.0));
    Simulation simulation(state, model, 1, Stepping::plain);
    for (int step = 0; step < 30; ++step) {
      simulation.advance(1);
      const State& now = simulation.state();
      const bool overlap = grain_of_id(now, 2).x - grain_of_id(now, 1).x < 2.0 * radius;
      const bool contact = std::any_of(now.contacts.begin(), now.contacts.end(),
                                       [](const Contact& c) { return c.name.partner == 2; });
      if (contact != overlap) FAIL("a contact is missed in trial " << trial << ", step " << step);
      met += contact;
    }
  }
  CHECK(met > 10000);
}

TEST_CASE("several threads go as by brute force") {
  const int threads = GENERATE(2, 3);
  CHECK(agree(small_tube(15), 100, paper_model(), threads, Stepping::plain).pairs_begun > 3);
}

TEST_CASE("many small systems go as by brute force") {
  // Where the engine sorts, and what it then knows of lasting contacts, differs in each.
  for (std::uint64_t seed = 100; seed < 140; ++seed) {
    CAPTURE(seed);
    agree(gas(4e-3, 5e-3, 8, 5.0, seed), 300);
  }
}
