// Visits put together from contacts that end in any order, looked at in any rhythm; and that real
// runs have the same visits with every stepping, any number of threads and after any resume.
#include "engine/wall_watch.hpp"
#include "tests/catch.hpp"
#include "tests/engine/systems.hpp"

#include <algorithm>
#include <utility>
#include <vector>

using namespace systems;

namespace {

/// A tube of two walls with a spacing of 1 mm and two grains; no gravity.
State two_grains() {
  State state = empty_box(8e-3, 8e-3);
  add_walls(state, 8);
  add_grain(state, grain(2e-3, 1e-3, 0.0, 0.0));
  add_grain(state, grain(6e-3, 1e-3, 0.0, 0.0));
  return state;
}

/// 1 m/s at the beginning and, without loss, at the end: its span goes on for 1 ms.
Contact touch(const ContactName& name, double begin, double end) {
  Contact contact{.name = name};
  contact.begin = begin;
  contact.end = end;
  contact.entry_rate = 0.6;
  contact.entry_slip = 0.8;
  contact.max_overlap = 1e-6;
  contact.impulse_x = 1e-7;
  contact.impulse_y = -2e-7;
  return contact;
}

constexpr double ms = 1e-3;

class Watched {
public:
  explicit Watched(State state = two_grains())
      : state_(std::move(state)), watch_(state_, paper_model()) {}
  void ended(const Contact& contact) { state_.tally.end(contact, radius + wall_radius); }
  void lasts(const Contact& contact) { state_.contacts = {contact}; }
  const VisitTally& look_at(double time) {
    state_.step = std::llround(time / state_.time_step);
    watch_.look(state_);
    return state_.tally.visits;
  }
  const State& state() const { return state_; }
  void nothing_lasts() { state_.contacts.clear(); }

private:
  State state_;
  WallWatch watch_;
};

}  // namespace

TEST_CASE("contacts that follow each other closely are one visit") {
  Watched w;
  w.ended(touch({0, 0, 1}, 1.0 * ms, 1.1 * ms));
  w.ended(touch({0, 0, 2}, 2.0 * ms, 2.1 * ms));
  w.ended(touch({0, 0, 3}, 3.2 * ms, 3.3 * ms));  // 1.1 ms later: another one
  const VisitTally& visits = w.look_at(100.0 * ms);
  CHECK(visits.visits() == 2);
  CHECK(visits.of_contacts[0] == 1);
  CHECK(visits.of_contacts[1] == 1);
  CHECK(w.state().open_visits.empty());
  CHECK(w.state().tally.brakes.contacts == 3);
  CHECK(std::abs(visits.dv_y.value() - 0.6) < 1e-12);
  CHECK(std::abs(visits.dv_x.value() - 0.3) < 1e-12);
}

TEST_CASE("grains and walls have visits of their own") {
  Watched w;
  w.ended(touch({0, 0, 1}, 1.0 * ms, 1.1 * ms));
  w.ended(touch({0, 1, 1}, 1.2 * ms, 1.3 * ms));
  w.ended(touch({1, 0, 1}, 1.4 * ms, 1.5 * ms));
  const VisitTally& visits = w.look_at(100.0 * ms);
  CHECK(visits.of_contacts[0] == 3);
  // The right wall pushes to the left: there the impulse along +x is towards the wall.
  CHECK(std::abs(visits.dv_x.value() - 0.1) < 1e-12);
}

TEST_CASE("each visitor has its own mass, wherever its slot is") {
  // Grain 1 is three times as heavy as grain 0, and comes first in the store.
  State unequal = two_grains();
  unequal.grains.id = {1, 0};
  unequal.grains.mass = {3.0 * mass, mass};
  Watched w(unequal);
  const int visitor = GENERATE(0, 1);
  const double its_mass = visitor == 0 ? mass : 3.0 * mass;
  Contact contact = touch({0, visitor, 1}, 1.0 * ms, 1.06 * ms);
  // The light one leaves with half of its speed, and needs 2 ms for a spacing; the other 1.15 ms.
  contact.normal_loss = 0.5 * 0.75 * mass;
  w.ended(contact);
  w.ended(touch({0, visitor, 2}, 2.56 * ms, 2.62 * ms));
  const VisitTally& visits = w.look_at(100.0 * ms);
  CHECK(visits.visits() == (visitor == 0 ? 1 : 2));
  CHECK(visits.dv_y.value() == Approx(4e-7 / its_mass));
  CHECK(visits.dv_x.value() == Approx(2e-7 / its_mass));
  // t_col is 71 us for the light one and 124 us for the other: 60 us are a passage for that only.
  CHECK(w.state().tally.brakes.cut_short == (visitor == 0 ? 0 : 2));
}

TEST_CASE("a visit is open until no contact can come any more") {
  Watched w;
  w.ended(touch({0, 0, 1}, 1.0 * ms, 1.1 * ms));
  CHECK(w.look_at(2.1 * ms).visits() == 0);
  CHECK(w.state().open_visits.size() == 1);
  SECTION("none has come") { CHECK(w.look_at(2.11 * ms).visits() == 1); }
  SECTION("one has come, and lasts") {
    w.lasts(touch({0, 0, 2}, 2.05 * ms, 2.06 * ms));
    CHECK(w.look_at(5.0 * ms).visits() == 0);
    w.nothing_lasts();
    w.ended(touch({0, 0, 2}, 2.05 * ms, 9.0 * ms));
    CHECK(w.look_at(9.5 * ms).visits() == 0);
    CHECK(w.look_at(11.0 * ms).of_contacts[1] == 1);
  }
  SECTION("one of another grain, of another wall or too late does not matter") {
    w.lasts(touch(GENERATE(ContactName{0, 1, 2}, ContactName{1, 0, 2}, ContactName{no_wall, 0, 1}),
                  2.05 * ms, 2.06 * ms));
    CHECK(w.look_at(5.0 * ms).visits() == 1);
    w.lasts(touch({0, 0, 2}, 2.2 * ms, 2.3 * ms));
    CHECK(w.look_at(5.0 * ms).visits() == 1);
  }
}

TEST_CASE("a long contact joins what came and went while it lasted") {
  Watched w;
  const Contact longest = touch({0, 0, 1}, 1.0 * ms, 9.0 * ms);
  w.lasts(longest);
  w.ended(touch({0, 0, 2}, 1.5 * ms, 1.6 * ms));
  w.ended(touch({0, 0, 3}, 6.0 * ms, 6.1 * ms));
  CHECK(w.look_at(8.9 * ms).visits() == 0);
  w.nothing_lasts();
  w.ended(longest);
  CHECK(w.look_at(50.0 * ms).of_contacts[2] == 1);
  CHECK(std::abs(w.state().tally.visits.entry_slip.value() - 0.8) < 1e-12);
}

TEST_CASE("what is known of open visits does not grow with their contacts") {
  // A grain that lies on one wall grain and rattles against the next, seldom.
  Watched w;
  w.lasts(touch({0, 0, 1}, 1.0 * ms, 1.1 * ms));
  for (int i = 0; i < 100; ++i) {
    const double begin = (2.0 + 5.0 * i) * ms;
    w.ended(touch({0, 0, 2}, begin, begin + 0.1 * ms));
    CHECK(w.look_at(begin + 4.0 * ms).visits() == 0);
    REQUIRE(w.state().open_visits.size() == 1);
  }
  w.nothing_lasts();
  w.ended(touch({0, 0, 1}, 1.0 * ms, 600.0 * ms));
  CHECK(w.look_at(700.0 * ms).contacts == 101);
}

TEST_CASE("neither the order of the ends nor the rhythm of the looks matters") {
  // Contacts at random, overlapping and not; each is known from the first look after its end.
  Dice dice(71);
  std::vector<Contact> contacts;
  for (int i = 0; i < 300; ++i) {
    const double begin = dice.between(0.0, 150.0 * ms);
    contacts.push_back(
        touch({static_cast<std::int32_t>(dice.below(2)), static_cast<std::int32_t>(dice.below(2)),
               static_cast<std::int32_t>(dice.below(8))},
              begin, begin + dice.between(0.01, 2.0) * ms));
    Contact& contact = contacts.back();
    for (double* part :
         {&contact.impulse_x, &contact.impulse_y, &contact.entry_rate, &contact.entry_slip})
      *part *= dice.between(0.5, 1.5);
  }
  // Some meet two wall grains at once: which of the two begins the visit is no matter of order.
  for (std::size_t i = 0; i < 300; i += 10) {
    Contact twin = contacts[i];
    twin.name.partner += 8;
    twin.end = twin.begin + dice.between(0.01, 2.0) * ms;
    twin.entry_rate *= dice.between(0.5, 1.5);
    contacts.push_back(twin);
  }
  Watched at_once;
  for (const Contact& contact : contacts) at_once.ended(contact);
  const VisitTally expected = at_once.look_at(200.0 * ms);
  REQUIRE(expected.visits() > 50);
  REQUIRE(expected.contacts == 330);

  State state = two_grains();
  const WallWatch watch(state, paper_model());
  double last = -1.0;
  for (double now = 0.0; now <= 200.0 * ms; last = now, now += dice.between(0.05, 5.0) * ms) {
    state.step = std::llround(now / state.time_step);
    const double t = state.time();
    state.contacts.clear();
    for (const Contact& c : contacts) {
      if (c.end > last && c.end <= t) state.tally.end(c, radius + wall_radius);
      if (c.begin <= t && c.end > t) state.contacts.push_back(c);
    }
    std::sort(state.contacts.begin(), state.contacts.end(),
              [](const Contact& a, const Contact& b) { return a.name < b.name; });
    std::reverse(state.tally.ended_at_walls.begin(), state.tally.ended_at_walls.end());
    watch.look(state);
    now = t;
  }
  state.step = 1'000'000;
  state.contacts.clear();
  watch.look(state);
  CHECK(state.tally.visits.of_contacts == expected.of_contacts);
  CHECK(state.tally.visits.dv_y == expected.dv_y);
  CHECK(state.tally.visits.dv_x == expected.dv_x);
  CHECK(state.tally.visits.entry_rate == expected.entry_rate);
  CHECK(state.tally.visits.entry_slip == expected.entry_slip);
  CHECK(state.tally.visits.entry_rates == expected.entry_rates);
  CHECK(state.tally.visits.entry_slips == expected.entry_slips);
}

TEST_CASE("a run has the same visits however it is done") {
  // Long enough for visits to begin, to go on and to be over. The hash has all of the tally.
  const State start = small_tube(72);
  const std::int64_t steps = 16000;
  const State expected = advanced(start, paper_model(), steps, 1, Stepping::plain);
  REQUIRE(expected.tally.visits.visits() > 20);
  REQUIRE(expected.tally.visits.contacts > expected.tally.visits.visits());
  REQUIRE_FALSE(expected.open_visits.empty());
  const auto check = [&](const State& other) {
    CHECK(other.tally.visits.of_contacts == expected.tally.visits.of_contacts);
    CHECK(other.tally.brakes.cut_short == expected.tally.brakes.cut_short);
    CHECK(state_hash(other) == state_hash(expected));
  };
  SECTION("by windows") { check(advanced(start, paper_model(), steps, 1, Stepping::windows)); }
  SECTION("by two threads") {
    const std::int64_t last = 600;  // threads that share a core are slow
    const State before = advanced(start, paper_model(), steps - last);
    REQUIRE(before.tally.visits.visits() < expected.tally.visits.visits());
    check(advanced(before, paper_model(), last, 2, GENERATE(Stepping::plain, Stepping::windows)));
  }
  SECTION("in pieces, taken up again from each") {
    Dice dice(73);
    State state = start;
    while (state.step < steps)
      state = advanced(shuffled(state, 74), paper_model(),
                       std::min(dice.below(500), steps - state.step), 1,
                       dice.below(2) == 0 ? Stepping::plain : Stepping::windows);
    check(state);
  }
}

TEST_CASE("every wall contact that has ended is in a visit, over or open") {
  const State end = advanced(small_tube(75), paper_model(), 4000);
  CHECK(end.tally.brakes.contacts == end.tally.walls.ended);
  std::int64_t contacts = end.tally.visits.contacts;
  for (const WallVisit& visit : end.open_visits) contacts += visit.contacts;
  CHECK(contacts == end.tally.walls.ended);
  CHECK(end.tally.brakes.duration == end.tally.walls.duration);
  CHECK(end.tally.brakes.friction_loss == end.tally.walls.friction_loss);
}
