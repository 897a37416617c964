// The hash is that of all that the future depends on, and of the tally: every part of it counts,
// the order of the slots does not.
#include "engine/state.hpp"
#include "tests/catch.hpp"
#include "tests/engine/systems.hpp"

#include <functional>
#include <vector>

using namespace systems;

namespace {

/// A state in the middle of things.
const State& state() {
  static const State some = [] {
    State tube = small_tube(41);
    State later = advanced(tube, paper_model(), 300);
    REQUIRE_FALSE(later.contacts.empty());
    REQUIRE(later.tally.walls.ended > 0);
    return later;
  }();
  return some;
}

bool noticed(const std::function<void(State&)>& change, const State& from) {
  State changed = from;
  change(changed);
  return state_hash(changed) != state_hash(from);
}

bool noticed(const std::function<void(State&)>& change) { return noticed(change, state()); }

}  // namespace

TEST_CASE("the hash does not depend on the order of the slots") {
  CHECK(state_hash(shuffled(state(), 1)) == state_hash(state()));
}

TEST_CASE("the hash notices every part of the motion") {
  CHECK(noticed([](State& s) { ++s.grains.position[3].x; }));
  CHECK(noticed([](State& s) { ++s.grains.position[3].y; }));
  CHECK(noticed([](State& s) { ++s.grains.u[3].x; }));
  CHECK(noticed([](State& s) { ++s.grains.u[3].y; }));
  CHECK(noticed([](State& s) { ++s.grains.kick[3].x; }));
  CHECK(noticed([](State& s) { ++s.grains.kick[3].y; }));
  CHECK(noticed([](State& s) { s.grains.radius[3] *= 1.0 + 1e-15; }));
  CHECK(noticed([](State& s) { s.grains.mass[3] *= 1.0 + 1e-15; }));
  CHECK(noticed([](State& s) { std::swap(s.grains.id[3], s.grains.id[4]); }));
  CHECK(noticed([](State& s) { ++s.step; }));
  CHECK(noticed([](State& s) { s.time_step *= 2.0; }));
  CHECK(noticed([](State& s) { s.gravity.y = 9.81; }));
  CHECK(noticed([](State& s) { s.gravity.x = 1e-9; }));
  CHECK(noticed([](State& s) { s.box.width *= 2.0; }));
  CHECK(noticed([](State& s) { s.box.length *= 2.0; }));
}

TEST_CASE("the hash notices the life of a contact") {
  CHECK(noticed([](State& s) { s.contacts.pop_back(); }));
  for (std::int32_t ContactName::*part :
       {&ContactName::wall, &ContactName::grain, &ContactName::partner})
    CHECK(noticed([&](State& s) { ++(s.contacts[0].name.*part); }));
  CHECK(noticed([](State& s) { s.contacts[0].begin -= 1e-9; }));
  CHECK(noticed([](State& s) { s.contacts[0].entry_rate += 1e-9; }));
  CHECK(noticed([](State& s) { s.contacts[0].entry_slip += 1e-9; }));
  CHECK(noticed([](State& s) { s.contacts[0].max_overlap *= 2.0; }));
  CHECK(noticed([](State& s) { s.contacts[0].slip_path *= 2.0; }));
  CHECK(noticed([](State& s) { s.contacts[0].normal_loss += 1e-20; }));
  CHECK(noticed([](State& s) { s.contacts[0].friction_loss += 1e-20; }));
  CHECK(noticed([](State& s) { s.contacts[0].friction_x += 1e-12; }));
  CHECK(noticed([](State& s) { s.contacts[0].friction_y += 1e-12; }));
}

TEST_CASE("the hash notices spins, and springs where there are any") {
  const State rotating = advanced(small_tube(41, 40, disc), rolling_model(), 300);
  REQUIRE_FALSE(rotating.contacts.empty());
  const auto noticed_of_rotating = [&](const std::function<void(State&)>& change) {
    return noticed(change, rotating);
  };
  CHECK(state_hash(shuffled(rotating, 1)) == state_hash(rotating));
  CHECK(noticed_of_rotating([](State& s) { ++s.grains.spin[3]; }));
  CHECK(noticed_of_rotating([](State& s) { ++s.grains.spin_kick[3]; }));
  CHECK(noticed_of_rotating([](State& s) { s.grains.inertia = sphere; }));
  CHECK(noticed_of_rotating([](State& s) { s.contacts[0].spring += 1e-15; }));
  CHECK(noticed_of_rotating([](State& s) { s.contacts[0].torque *= 2.0; }));
  CHECK(noticed_of_rotating([](State& s) { s.contacts[0].rolling_torque *= 2.0; }));
}

TEST_CASE("the hash notices every sum of the tally") {
  CHECK(noticed([](State& s) { ++s.tally.walls.begun; }));
  CHECK(noticed([](State& s) { ++s.tally.walls.ended; }));
  CHECK(noticed([](State& s) { s.tally.grains.max_overlap *= 2.0; }));
  for (ExactSum ContactTally::*sum :
       {&ContactTally::duration, &ContactTally::slip_path, &ContactTally::normal_loss,
        &ContactTally::friction_loss, &ContactTally::energy_won, &ContactTally::impulse_y,
        &ContactTally::impulse_y_times_time})
    CHECK(noticed([&](State& s) { (s.tally.walls.*sum).add(1e-20); }));
  for (ExactSum BrakeTally::*sum :
       {&BrakeTally::braking, &BrakeTally::braking_cut_short, &BrakeTally::friction_loss,
        &BrakeTally::friction_loss_cut_short, &BrakeTally::entry_slip, &BrakeTally::duration,
        &BrakeTally::pulling})
    CHECK(noticed([&](State& s) { (s.tally.brakes.*sum).add(1e-20); }));
  for (ExactSum VisitTally::*sum :
       {&VisitTally::dv_y, &VisitTally::dv_x, &VisitTally::entry_rate, &VisitTally::entry_slip})
    CHECK(noticed([&](State& s) { (s.tally.visits.*sum).add(1e-20); }));
}

TEST_CASE("the hash notices both halves of a sum") {
  CHECK(noticed([](State& s) { s.tally.walls.duration.add(0x1p-90); }));
  CHECK(noticed([](State& s) { s.tally.walls.duration.add(0x1p-26); }));  // leaves the lower half
}

TEST_CASE("the hash notices what the balances and the tally will need") {
  CHECK(noticed([](State& s) { s.contacts[0].end += 1e-9; }));
  CHECK(noticed([](State& s) { s.contacts[0].impulse_y += 1e-12; }));
  CHECK(noticed([](State& s) { s.contacts[0].impulse_y_times_time += 1e-12; }));
  CHECK(noticed([](State& s) { s.origin.energy *= 2.0; }));
  CHECK(noticed([](State& s) { s.origin.momentum_y *= 2.0; }));
}

TEST_CASE("the hash notices where the grains began where gravity is at an angle") {
  State tilted = state();
  tilted.gravity.x = -1.0;
  CHECK(noticed([](State& s) { s.origin.moment_x += 1e-15; }, tilted));
  CHECK(noticed([](State& s) { s.gravity.x *= 2.0; }, tilted));
}

TEST_CASE("the hash notices walls that move, and their work") {
  CHECK(noticed([](State& s) { s.walls[0].motion.velocity = 1e-9; }));
  CHECK(noticed([](State& s) { s.walls[1].motion = {.amplitude_y = 1e-9, .frequency = 1.0}; }));
  CHECK(noticed([](State& s) { s.walls[1].motion = {.amplitude_x = 1e-9, .frequency = 1.0}; }));
  CHECK(noticed([](State& s) { s.walls[1].motion = {.amplitude_x = 1e-9, .phase = 1.0}; }));
  CHECK(noticed([](State& s) { s.tally.impulses.work.add(1e-20); }));
}

TEST_CASE("the hash notices each part of the motion of a wall that has all of them") {
  State moving = state();
  moving.walls[1].motion = {.velocity = 0.1,
                            .amplitude_x = 1e-3,
                            .amplitude_y = 2e-3,
                            .frequency = 50.0,
                            .phase = 0.5,
                            .start = 1000};
  for (double WallMotion::*part :
       {&WallMotion::velocity, &WallMotion::amplitude_x, &WallMotion::amplitude_y,
        &WallMotion::frequency, &WallMotion::phase})
    CHECK(noticed([&](State& s) { s.walls[1].motion.*part *= 1.0 + 1e-12; }, moving));
  CHECK(noticed([](State& s) { ++s.walls[1].motion.start; }, moving));
}

TEST_CASE("the hash notices every histogram") {
  CHECK(noticed([](State& s) { s.tally.grains.durations.add(1e-5); }));
  CHECK(noticed([](State& s) { s.tally.grains.overlaps.add(1e-3); }));
  CHECK(noticed([](State& s) { s.tally.walls.durations.add(1e-5); }));
  CHECK(noticed([](State& s) { s.tally.walls.overlaps.add(1e-3); }));
  CHECK(noticed([](State& s) { s.tally.visits.entry_rates.add(1.0); }));
  CHECK(noticed([](State& s) { s.tally.visits.entry_slips.add(1.0); }));
}

TEST_CASE("the hash notices contacts as brakes, and visits") {
  CHECK(noticed([](State& s) { s.open_visits.pop_back(); }));
  CHECK(noticed([](State& s) { ++s.open_visits[0].wall; }));
  CHECK(noticed([](State& s) { ++s.open_visits[0].grain; }));
  CHECK(noticed([](State& s) { s.open_visits[0].span.begin -= 1e-9; }));
  CHECK(noticed([](State& s) { s.open_visits[0].span.end += 1e-9; }));
  CHECK(noticed([](State& s) { ++s.open_visits[0].contacts; }));
  CHECK(noticed([](State& s) { s.open_visits[0].entry_rate += 1e-9; }));
  CHECK(noticed([](State& s) { s.open_visits[0].entry_slip += 1e-9; }));
  CHECK(noticed([](State& s) { s.open_visits[0].impulse_x.add(1e-20); }));
  CHECK(noticed([](State& s) { s.open_visits[0].impulse_y.add(1e-20); }));
  CHECK(noticed([](State& s) { s.contacts[0].impulse_x += 1e-12; }));
  CHECK(noticed([](State& s) { ++s.tally.brakes.contacts; }));
  CHECK(noticed([](State& s) { ++s.tally.brakes.cut_short; }));
  CHECK(noticed([](State& s) { ++s.tally.visits.of_contacts[7]; }));
  CHECK(noticed([](State& s) { ++s.tally.visits.contacts; }));
}

TEST_CASE("the hash notices the walls") {
  CHECK(noticed([](State& s) { s.walls.pop_back(); }));
  CHECK(noticed([](State& s) { s.walls[0].line += 1e-6; }));
  CHECK(noticed([](State& s) { s.walls[0].radius *= 2.0; }));
  CHECK(noticed([](State& s) { ++s.walls[0].count; }));
}

TEST_CASE("each grain is in the slot of its id") {
  const Grains& grains = state().grains;
  const std::vector<std::size_t> slots = slots_by_id(grains);
  REQUIRE(slots.size() == grains.size());
  for (std::size_t id = 0; id < slots.size(); ++id)
    CHECK(grains.id[slots[id]] == static_cast<std::int32_t>(id));
}
