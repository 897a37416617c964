// The life of a contact: begin, end, partners, largest overlap and slip path, against a log of
// events by brute force; and that nothing the engine does between two steps cuts it in two.
#include "engine/observables.hpp"
#include "engine/simulation.hpp"
#include "tests/bits.hpp"
#include "tests/catch.hpp"
#include "tests/engine/brute_force.hpp"
#include "tests/engine/systems.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

using namespace systems;

namespace {

/// Ended contacts as they were in their last step, in the order in which they ended.
std::vector<Contact> watch(const State& start, std::int64_t steps, Stepping stepping) {
  Simulation simulation(start, paper_model(), 1, stepping);
  std::vector<Contact> ended, before;
  for (std::int64_t step = 1; step <= steps; ++step) {
    simulation.advance(1);
    const std::vector<Contact>& now = simulation.state().contacts;
    for (const Contact& contact : before)
      if (std::none_of(now.begin(), now.end(),
                       [&](const Contact& c) { return c.name == contact.name; }))
        ended.push_back(contact);
    before = now;
  }
  return ended;
}

brute_force::Stepper reference(const State& start, std::int64_t steps) {
  brute_force::Stepper stepper(start, paper_model());
  for (std::int64_t step = 1; step <= steps; ++step) stepper.step();
  return stepper;
}

/// The first step from `step` on in which a contact with a wall lasts.
std::int64_t step_within_a_wall_contact(const State& start, std::int64_t step) {
  Simulation simulation(start, paper_model(), 1);
  simulation.advance(step);
  const auto at_wall = [](const Contact& c) { return c.name.wall != no_wall; };
  while (std::ranges::none_of(simulation.state().contacts, at_wall)) simulation.advance(1);
  return simulation.state().step;
}

/// Two grains in a long, soft contact, and a fast third one that makes the engine sort again and
/// again.
State disturbed_contact() {
  State state = empty_box(20e-3, 20e-3);
  add_grain(state, grain(5e-3, 5e-3, 0.1, 0.0));
  add_grain(state, grain(6.001e-3, 5e-3, -0.1, 0.0));
  add_grain(state, grain(10e-3, 15e-3, 30.0, 0.3));
  return state;
}

/// Between grains or at one of two walls; may have won energy.
Contact any_contact(Dice& dice) {
  Contact contact{.name = {static_cast<std::int32_t>(dice.below(3)) - 1, 0, 1}};
  contact.begin = dice.between(0.0, 1.0);
  contact.end = contact.begin + dice.between(1e-6, 1e-4);
  contact.max_overlap = dice.between(1e-6, 1e-4);
  for (double* part : {&contact.entry_rate, &contact.entry_slip, &contact.slip_path})
    *part = dice.between(0.1, 1.0);
  for (double* part : {&contact.normal_loss, &contact.friction_loss, &contact.impulse_x,
                       &contact.impulse_y, &contact.impulse_y_times_time})
    *part = dice.between(-1e-6, 1e-6);
  return contact;
}

ContactModel soft() {
  ContactModel model = paper_model();
  model.normal = LinearLaw{20.0, 100.0};  // t_col = 0.5 ms
  return model;
}

}  // namespace

TEST_CASE("each contact lives as in the log of events") {
  // Both see the same steps; sums differ by rounding. Surfaces slip otherwise where grains turn.
  const State start = small_tube(21, 40, GENERATE(0.0, disc));
  const std::int64_t steps = 800;
  const Stepping stepping = GENERATE(Stepping::plain, Stepping::windows);
  const std::vector<Contact> lives = watch(start, steps, stepping);
  const brute_force::Stepper log = reference(start, steps);
  REQUIRE(lives.size() == log.ended().size());
  REQUIRE(lives.size() > 20);
  for (std::size_t i = 0; i < lives.size(); ++i) {
    const Contact& contact = lives[i];
    const auto& [name, life] = log.ended()[i];
    REQUIRE(contact.name == name);
    const double dt = start.time_step;
    // It began after the last step without it, and ended before the first without it.
    CHECK(contact.begin > dt * (static_cast<double>(life.first_step) - 1.0 - 1e-6));
    CHECK(contact.begin <= dt * static_cast<double>(life.first_step));
    CHECK(contact.end >= dt * static_cast<double>(life.last_step));
    CHECK(contact.end < dt * (static_cast<double>(life.last_step) + 1.0 + 1e-6));
    CHECK(std::abs(contact.max_overlap / life.max_overlap - 1.0) < 1e-6);
    CHECK(std::abs(contact.slip_path / life.slip_path - 1.0) < 1e-6);
    CHECK(contact.entry_rate > 0.0);
  }
}

TEST_CASE("the tally is the sum over the lives") {
  const State start = small_tube(22);
  const std::int64_t steps = 800;
  const Stepping stepping = GENERATE(Stepping::plain, Stepping::windows);
  const std::vector<Contact> lives = watch(start, steps, stepping);
  const State end = advanced(start, paper_model(), steps, 1, stepping);

  ContactTally grains, walls;
  for (const Contact& contact : lives) {
    const bool at_wall = contact.name.wall != no_wall;
    ContactTally& kind = at_wall ? walls : grains;
    kind.add(contact);
    ++kind.ended;
    kind.durations.add(contact.duration());
    const double second = at_wall ? wall_radius : grain_of_id(start, contact.name.partner).radius;
    kind.overlaps.add(contact.max_overlap
                      / (grain_of_id(start, contact.name.grain).radius + second));
  }
  for (const auto& [sum, tally] :
       {std::pair{&grains, &end.tally.grains}, std::pair{&walls, &end.tally.walls}}) {
    CHECK(sum->ended > 0);
    CHECK(tally->ended == sum->ended);
    CHECK(tally->duration == sum->duration);
    CHECK(tally->slip_path == sum->slip_path);
    CHECK(tally->normal_loss == sum->normal_loss);
    // The loss of a contact's last step becomes known when nobody can watch it any more.
    CHECK(std::abs(tally->friction_loss.value() / sum->friction_loss.value() - 1.0) < 0.01);
    CHECK(tally->impulse_y == sum->impulse_y);
    CHECK(tally->max_overlap == sum->max_overlap);
    CHECK(tally->durations == sum->durations);
    CHECK(tally->overlaps == sum->overlaps);
  }
  const auto lasting = static_cast<std::int64_t>(end.contacts.size());
  CHECK(end.tally.grains.begun + end.tally.walls.begun - grains.ended - walls.ended == lasting);
}

TEST_CASE("the tallies of two threads together are that of one") {
  Dice dice(24);
  Tally one, left, right;
  for (int i = 0; i < 60; ++i) {
    const Contact contact = any_contact(dice);
    const double work = dice.between(-1e-6, 1e-6);
    for (Tally* tally : {&one, i % 2 == 0 ? &left : &right}) {
      ++tally->of(contact.name).begun;
      tally->end(contact, 2.0 * radius);
      tally->impulses.work.add(work);
    }
  }
  REQUIRE(right.grains.energy_won.value() > 0.0);
  left.merge(right);
  CHECK((bits_of(left.grains) == bits_of(one.grains)));  // in brackets: not to be printed
  CHECK((bits_of(left.walls) == bits_of(one.walls)));
  CHECK(left.impulses.x == one.impulses.x);
  CHECK(left.impulses.y == one.impulses.y);
  CHECK(left.impulses.work == one.impulses.work);
  CHECK(left.ended_at_walls.size() == one.ended_at_walls.size());
}

TEST_CASE("each wall has given what the log of events says") {
  const State start = small_tube(23);
  const std::int64_t steps = step_within_a_wall_contact(start, 700);
  const Stepping stepping = GENERATE(Stepping::plain, Stepping::windows);
  const int threads = GENERATE(1, 2);
  const State end = advanced(start, paper_model(), steps, threads, stepping);
  const brute_force::Stepper log = reference(start, steps);
  const Observables o = observe(end);
  for (std::size_t wall : {0U, 1U}) {
    CAPTURE(wall, o.impulse_y_of_wall[wall]);
    CHECK(std::abs(o.impulse_y_of_wall[wall]) > 0.05 * mass);  // kg m/s: not next to nothing
    CHECK(o.impulse_y_of_wall[wall] == Approx(log.impulse_of_wall(wall).y()).epsilon(1e-6));
    CHECK(o.impulse_x_of_wall[wall] == Approx(log.impulse_of_wall(wall).x()).epsilon(1e-6));
    CHECK(o.impulse_x_of_wall[wall] * (wall == 0 ? 1.0 : -1.0) > 0.0);  // walls push inwards
  }
  CHECK(o.impulse_y_of_wall[0] + o.impulse_y_of_wall[1] == Approx(o.wall_impulse_y).epsilon(1e-14));
  ExactSum ended = end.tally.impulses.y[0];
  ended.add(end.tally.impulses.y[1]);
  CHECK(ended == end.tally.walls.impulse_y);
}

TEST_CASE("the beginning of a contact is resolved within the step") {
  // Head-on at constant velocity until the first touch: the extrapolation is exact up to the force
  // of one step.
  const double phase = GENERATE(0.1, 0.5, 0.9);
  State state = empty_box(20e-3, 20e-3);
  const double v = 1.0, met = (7.0 + phase) * time_step;
  add_grain(state, grain(5e-3, 5e-3, v, 0.0));
  add_grain(state, grain(6e-3 + v * met, 5e-3, 0.0, 0.0));
  const State after = advanced(state, paper_model(), 10);
  REQUIRE(after.contacts.size() == 1);
  CHECK(std::abs(after.contacts[0].begin - met) < 1e-2 * time_step);
  CHECK(std::abs(after.contacts[0].entry_rate / v - 1.0) < 3e-2);  // a kick of a step late
  CHECK(std::abs(after.contacts[0].entry_slip) < 1e-12);
}

TEST_CASE("the slip at the beginning is that of the centres, however fast the surfaces are") {
  State state = empty_box(20e-3, 20e-3);
  state.grains.inertia = disc;
  SECTION("of two grains") {
    add_grain(state, {5e-3, 5e-3, 1.0, 0.0, radius, mass, 2000.0});
    add_grain(state, {6.003e-3, 5e-3, -1.0, 0.0, radius, mass, 1000.0});
  }
  SECTION("of a grain and a wall") {
    add_walls(state, 20);
    add_grain(state, {radius + wall_radius + 3e-6, 5e-3, -1.0, 0.0, radius, mass, 2000.0});
  }
  const State after = advanced(state, paper_model(), 10);
  REQUIRE(after.contacts.size() == 1);
  CHECK(after.contacts[0].entry_rate == Approx(state.walls.empty() ? 2.0 : 1.0).epsilon(0.05));
  CHECK(std::abs(after.contacts[0].entry_slip) < 1e-12);
  CHECK(after.contacts[0].slip_path > 1e-6);
}

TEST_CASE("a grain that slides along a plane slips as far as Coulomb's law says") {
  // Half an oscillation against the plane, during which friction takes mu times the impulse.
  const double approach = 0.2, along = GENERATE(0.5, 3.0), mu = GENERATE(0.0, 0.5);
  State state = empty_box(20e-3, 20e-3);
  state.time_step = 0.1 * time_step;
  for (const double line : {0.0, state.box.width})
    state.walls.push_back(WallLattice::smooth_at(line));
  add_grain(state, grain(radius + 1e-6, 5e-3, -approach, along));
  const ContactModel elastic{LinearLaw{stiffness, 0.0}, CappedSlip{}, mu, Attraction::keep};
  const State after = advanced(state, elastic, 1000, 1, Stepping::plain);
  REQUIRE(after.tally.walls.ended == 1);
  const double duration = std::numbers::pi * std::sqrt(mass / stiffness);
  CHECK(after.tally.walls.duration.value() == Approx(duration).epsilon(1e-3));
  CHECK(after.tally.walls.slip_path.value()
        == Approx((along - mu * approach) * duration).epsilon(2e-3));
}

TEST_CASE("sorting in the middle of a contact does not end it") {
  const Stepping stepping = GENERATE(Stepping::plain, Stepping::windows);
  Simulation simulation(disturbed_contact(), soft(), 1, stepping);
  simulation.advance(100);
  REQUIRE(simulation.state().contacts.size() == 1);
  const double begin = simulation.state().contacts[0].begin;
  double overlap = 0.0;
  for (int i = 0; i < 30; ++i) {
    simulation.advance(10);
    REQUIRE(simulation.state().contacts.size() == 1);
    CHECK(simulation.state().contacts[0].begin == begin);
    CHECK(simulation.state().contacts[0].max_overlap >= overlap);
    overlap = simulation.state().contacts[0].max_overlap;
  }
  simulation.advance(400);
  CHECK(simulation.state().contacts.empty());
  CHECK(simulation.state().tally.grains.begun == 1);
  CHECK(simulation.state().tally.grains.ended == 1);
}

TEST_CASE("a contact that is met again is a new contact") {
  // A grain bounces between two walls: the same wall grains, again and again.
  State state = empty_box(3e-3, 20e-3);
  add_walls(state, 1);
  add_grain(state, grain(1.5e-3, 0.0, 5.0, 0.0));
  const State after = advanced(state, frictionless(0.0), 3000);
  // free path 3 - 2 * 0.83 = 1.34 mm: 0.27 ms and 0.07 ms of contact per crossing
  CHECK(after.tally.walls.begun >= 8);
  CHECK(after.tally.walls.begun - after.tally.walls.ended
        == static_cast<std::int64_t>(after.contacts.size()));
}

TEST_CASE("contacts are listed in the order of their names, each once") {
  State state = small_tube(23);
  Simulation simulation(state, soft(), 1);
  for (int i = 0; i < 30; ++i) {
    simulation.advance(20);
    const std::vector<Contact>& contacts = simulation.state().contacts;
    const auto not_before = [](const Contact& a, const Contact& b) { return a.name >= b.name; };
    CHECK(std::adjacent_find(contacts.begin(), contacts.end(), not_before) == contacts.end());
    for (const Contact& contact : contacts) {
      if (contact.name.wall == no_wall) CHECK(contact.name.grain < contact.name.partner);
      CHECK(contact.overlap > 0.0);
      CHECK(contact.overlap <= contact.max_overlap);
    }
  }
  CHECK(simulation.state().contacts.size() > 5);
}

TEST_CASE("a grain between two others knows both of them") {
  State state = empty_box(20e-3, 20e-3);
  add_grain(state, grain(5e-3, 5e-3, 1.0, 0.0));
  add_grain(state, grain(6.01e-3, 5e-3, 0.0, 0.0));
  add_grain(state, grain(7.02e-3, 5e-3, -1.0, 0.0));
  const State after = advanced(state, paper_model(), 20);
  REQUIRE(after.contacts.size() == 2);
  CHECK(after.contacts[0].name == ContactName{no_wall, 0, 1});
  CHECK(after.contacts[1].name == ContactName{no_wall, 1, 2});
}
