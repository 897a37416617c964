// Spans of contacts and sums over visits, on contacts made by hand.
#include "engine/wall_visits.hpp"
#include "tests/catch.hpp"
#include "tests/engine/systems.hpp"

#include <algorithm>
#include <array>
#include <cmath>

using namespace systems;

namespace {

constexpr double wall_spacing = 1.2e-3;  // m

Contact contact_of(double rate, double slip, double loss = 0.0) {
  Contact contact{.name = {0, 0, 0}};
  contact.begin = 1.0;
  contact.end = 1.5;
  contact.entry_rate = rate;
  contact.entry_slip = slip;
  contact.normal_loss = 0.25 * loss;
  contact.friction_loss = 0.75 * loss;
  return contact;
}

/// s, from the end of the contact on
double patience(const Contact& contact, double gravity = 0.0) {
  return visit_span(contact, mass, wall_spacing, gravity).end - contact.end;
}

}  // namespace

TEST_CASE("a span goes on for a path of one spacing at the leaving speed") {
  CHECK(visit_span(contact_of(0.3, 0.4), mass, wall_spacing, 0.0).begin == 1.0);
  CHECK(std::abs(patience(contact_of(0.3, -0.4)) - wall_spacing / 0.5) < 1e-12);
  // Of m v^2 / 2 = 1.25e-7 J all but a quarter is lost: half the speed.
  CHECK(std::abs(patience(contact_of(0.3, 0.4, 0.75 * 1.25e-7)) - wall_spacing / 0.25) < 1e-12);
}

TEST_CASE("the leaving speed is at least a tenth of that of the entry") {
  CHECK(std::abs(patience(contact_of(0.3, 0.4, 1.0)) - wall_spacing / 0.05) < 1e-12);
}

TEST_CASE("gravity shortens the way of a slow grain") {
  const double speed = 0.05, gravity = 10.0;
  const double t = patience(contact_of(0.03, 0.04), gravity);
  CHECK(std::abs(speed * t + 0.5 * gravity * t * t - wall_spacing) < 1e-12);
  CHECK(patience(contact_of(0.03, 0.04), -gravity) == t);
}

TEST_CASE("a visit is the sum of its contacts and enters with the first") {
  std::array<Contact, 3> contacts = {contact_of(0.2, -1.0), contact_of(0.1, 0.9),
                                     contact_of(0.1, 0.8)};
  contacts[1].begin = contacts[2].begin = 2.0;
  contacts[0].impulse_x = 2e-7;
  contacts[1].impulse_x = 1e-7;
  contacts[2].impulse_x = -5e-8;
  contacts[0].impulse_y = -3e-7;
  contacts[2].impulse_y = 1e-7;
  const auto piece = [&](std::size_t i) {
    return WallVisit(contacts[i], {contacts[i].begin, 5.0 - static_cast<double>(i)});
  };
  std::array<std::size_t, 3> order = {0, 1, 2};
  do {
    WallVisit visit = piece(order[0]);
    visit.join(piece(order[1]));
    visit.join(piece(order[2]));
    CHECK(visit.span.begin == 1.0);
    CHECK(visit.span.end == 5.0);
    CHECK(visit.contacts == 3);
    CHECK(visit.entry_rate == 0.2);
    CHECK(visit.entry_slip == 1.0);
    CHECK(std::abs(visit.impulse_x.value() - 2.5e-7) < 1e-20);
    CHECK(std::abs(visit.impulse_y.value() + 2e-7) < 1e-20);
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST_CASE("contacts that begin at once are joined alike in any order") {
  const WallVisit left(contact_of(0.3, 0.4), {1.0, 2.0}), right(contact_of(0.3, -0.39), {1.0, 2.1});
  WallVisit one = left, other = right;
  one.join(right);
  other.join(left);
  CHECK(one.entry_slip == other.entry_slip);
  CHECK(one.span.end == other.span.end);
}

TEST_CASE("the tally of visits sums in units of velocity") {
  Contact contact = contact_of(0.2, -1.0);
  contact.impulse_x = 2.5e-7;
  contact.impulse_y = -2e-7;
  WallVisit visit(contact, {1.0, 2.0});
  visit.contacts = 3;
  VisitTally tally;
  tally.add(visit, mass, 1.0);
  CHECK(tally.visits() == 1);
  CHECK(tally.of_contacts[2] == 1);
  CHECK(tally.contacts == 3);
  CHECK(std::abs(tally.dv_y.value() - 0.2) < 1e-12);
  CHECK(std::abs(tally.dv_x.value() - 0.25) < 1e-12);
  CHECK(std::abs(tally.entry_rate.value() - 0.2) < 1e-12);
  CHECK(std::abs(tally.entry_slip.value() - 1.0) < 1e-12);

  VisitTally opposite;  // at the other wall, away is to the left
  opposite.add(visit, mass, -1.0);
  CHECK(opposite.dv_x.value() == -tally.dv_x.value());
}

TEST_CASE("long visits are counted together") {
  WallVisit visit(contact_of(0.1, 0.1), {1.0, 2.0});
  VisitTally tally;
  for (const std::int64_t contacts : {8, 11, 7}) {
    visit.contacts = contacts;
    tally.add(visit, mass, 1.0);
  }
  CHECK(tally.of_contacts[7] == 2);
  CHECK(tally.of_contacts[6] == 1);
  CHECK(tally.contacts == 26);
}
