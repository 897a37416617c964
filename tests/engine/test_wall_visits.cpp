// Spans of contacts and sums over visits, on contacts made by hand.
#include "engine/wall_visits.hpp"
#include "tests/catch.hpp"
#include "tests/engine/systems.hpp"

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
  std::array<Contact, 3> visit = {contact_of(0.2, -1.0), contact_of(0.1, 0.9),
                                  contact_of(0.1, 0.8)};
  visit[0].impulse_x = 2e-7;
  visit[1].impulse_x = 1e-7;
  visit[2].impulse_x = -5e-8;
  visit[0].impulse_y = -3e-7;
  visit[2].impulse_y = 1e-7;
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

  tally.merge(opposite);
  CHECK(tally.visits() == 2);
  CHECK(tally.contacts == 6);
  CHECK(tally.dv_x.value() == 0.0);
}

TEST_CASE("long visits are counted together") {
  const std::vector<Contact> many(11, contact_of(0.1, 0.1));
  VisitTally tally;
  tally.add(many, mass, 1.0);
  tally.add(std::span(many).first(8), mass, 1.0);
  CHECK(tally.of_contacts[7] == 2);
  CHECK(tally.contacts == 19);
}
