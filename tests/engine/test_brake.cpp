// Contacts as brakes, on contacts made by hand.
#include "engine/brake.hpp"
#include "engine/closed_forms.hpp"
#include "engine/tally.hpp"
#include "tests/catch.hpp"
#include "tests/engine/systems.hpp"

#include <cmath>
#include <numbers>
#include <utility>

using namespace systems;

namespace {

const LinearLaw linear{stiffness, damping};

ContactModel with(const NormalLaw& normal) { return {normal, CappedSlip{}, 0.5, Attraction::keep}; }

double t_col() { return collision_time(linear, mass, 1.0); }

Contact lasting_for(double duration, double entry_rate = 0.1) {
  Contact contact{.name = {0, 3, 5}};
  contact.begin = 2.0;
  contact.end = 2.0 + duration;
  contact.entry_rate = entry_rate;
  contact.entry_slip = -1.5;
  contact.max_overlap = 1e-6;
  contact.friction_loss = 3e-9;
  return contact;
}

}  // namespace

TEST_CASE("cut short is what lasts less than a passage of t_col") {
  CHECK(std::abs(cut_short_below - 2.0 / std::numbers::pi * std::atan(std::numbers::pi / 2.0))
        < 1e-4);
  CHECK_FALSE(is_cut_short(lasting_for(t_col()), with(linear), mass));
  CHECK_FALSE(is_cut_short(lasting_for(0.65 * t_col()), with(linear), mass));
  CHECK(is_cut_short(lasting_for(0.63 * t_col()), with(linear), mass));
  CHECK(is_cut_short(lasting_for(0.01 * t_col()), with(linear), mass));
}

TEST_CASE("t_col is that of the grain's own mass") {
  const Contact contact = lasting_for(0.7 * t_col());
  CHECK_FALSE(is_cut_short(contact, with(linear), mass));
  CHECK(is_cut_short(contact, with(linear), 2.0 * mass));
}

TEST_CASE("where t_col depends on the speed it is that of the entry") {
  const HertzKuwabaraKonoLaw hertz{5e5, 3.3};
  const double fast = collision_time(hertz, mass, 1.0);
  CHECK_FALSE(is_cut_short(lasting_for(0.7 * fast, 1.0), with(hertz), mass));
  CHECK(is_cut_short(lasting_for(0.7 * fast, 0.1), with(hertz), mass));
}

TEST_CASE("a passage that is first seen on its way out is cut short too") {
  CHECK(is_cut_short(lasting_for(0.02 * t_col(), -0.3), with(linear), mass));
  CHECK(is_cut_short(lasting_for(0.02 * t_col(), 0.0), with(linear), mass));
}

TEST_CASE("a contact that may not pull ends earlier, which does not cut it short") {
  const double strong = damping_for_restitution(0.15, stiffness, mass, Attraction::clip);
  const ContactModel clipped{LinearLaw{stiffness, strong}, CappedSlip{}, 0.5, Attraction::clip};
  const ContactModel kept{LinearLaw{stiffness, strong}, CappedSlip{}, 0.5, Attraction::keep};
  const double duration = collision_time(clipped.normal, mass, 1.0, Attraction::clip);
  CHECK_FALSE(is_cut_short(lasting_for(0.65 * duration), clipped, mass));
  CHECK(is_cut_short(lasting_for(0.63 * duration), clipped, mass));
  CHECK(is_cut_short(lasting_for(duration), kept, mass));
}

TEST_CASE("an overdamped contact is measured by its elastic time") {
  const LinearLaw overdamped{stiffness, 1e6};
  const double elastic = elastic_collision_time(overdamped.elastic_line(), mass, 1.0);
  CHECK_FALSE(is_cut_short(lasting_for(elastic), with(overdamped), mass));
  CHECK(is_cut_short(lasting_for(0.5 * elastic), with(overdamped), mass));
}

TEST_CASE("a head-on contact pulls for as long as eq. (1) says") {
  // Its overlap is a damped sine, whose second derivative vanishes (2/pi) arctan(gamma / 2 omega)
  // of t_col before the end. The parabola that stands for it tells less, by up to `too_little` of
  // that, in which is the bisection, too.
  const auto [gamma, too_little] = GENERATE(std::pair(1e3, 0.025), std::pair(5e3, 0.042),
                                            std::pair(1e4, 0.081), std::pair(2e4, 0.167));
  CAPTURE(gamma);
  const ContactModel model{LinearLaw{stiffness, gamma}, CappedSlip{}, 0.5, Attraction::keep};
  const double duration = LinearContact{stiffness, gamma, mass}.collision_time();
  const double exact =
      2.0 / std::numbers::pi * std::atan(gamma * duration / (2.0 * std::numbers::pi));
  const double estimated = pulling_time(lasting_for(duration), model, mass) / duration;
  CHECK(estimated / exact < 1.0);
  CHECK(estimated / exact > 1.0 - too_little);
}

TEST_CASE("a contact pulls from where the force along its parabola vanishes") {
  // With the overlap 4 depth s (1 - s), 0 < s < 1, that is where s (1 - s) + c (1 - 2 s) = 0 with
  // c = gamma m / (k duration), whatever the depth. A contact that was cut short pulls for longer.
  const double gamma = GENERATE(1e3, 5e3, 1e4, 2e4);
  const double part = GENERATE(0.2, 0.5, 1.0);
  CAPTURE(gamma, part);
  const ContactModel model{LinearLaw{stiffness, gamma}, CappedSlip{}, 0.5, Attraction::keep};
  const double duration = part * LinearContact{stiffness, gamma, mass}.collision_time();
  const double c = gamma * mass / (stiffness * duration);
  const double pulling = 0.5 + c - std::sqrt(0.25 + c * c);
  CHECK(std::abs(pulling_time(lasting_for(duration), model, mass) / duration - pulling) < 1.3e-4);
}

TEST_CASE("what does not pull does not pull") {
  ContactModel model = paper_model();
  CHECK(pulling_time(lasting_for(t_col()), model, mass) > 0.0);
  model.attraction = Attraction::clip;
  CHECK(pulling_time(lasting_for(t_col()), model, mass) == 0.0);
  CHECK(pulling_time(lasting_for(t_col()), frictionless(0.0), mass) == 0.0);
}

TEST_CASE("braking is what takes axial momentum") {
  BrakeTally tally;
  Contact contact = lasting_for(t_col());
  contact.impulse_y = -2e-7;
  tally.add(contact, paper_model(), mass, false);
  contact.impulse_y = 5e-7;  // one that pushes downstream
  tally.add(contact, paper_model(), mass, false);
  contact.impulse_y = -1e-7;
  contact.end = contact.begin + 0.1 * t_col();
  tally.add(contact, paper_model(), mass, false);

  CHECK(tally.contacts == 3);
  CHECK(tally.cut_short == 1);
  CHECK(std::abs(tally.braking.value() - 3e-7) < 1e-20);
  CHECK(std::abs(tally.braking_cut_short.value() - 1e-7) < 1e-20);
  CHECK(std::abs(tally.friction_loss.value() - 9e-9) < 1e-20);
  CHECK(std::abs(tally.friction_loss_cut_short.value() - 3e-9) < 1e-20);
  CHECK(std::abs(tally.entry_slip.value() - 4.5) < 1e-12);
  CHECK(std::abs(tally.duration.value() - 2.1 * t_col()) < 1e-12);
}

TEST_CASE("a tally hands on contacts with walls, and counts all durations") {
  Tally tally;
  tally.end(lasting_for(1e-4), 1e-3);
  Contact of_grains = lasting_for(1e-5);
  of_grains.name = {no_wall, 1, 2};
  tally.end(of_grains, 1e-3);
  REQUIRE(tally.ended_at_walls.size() == 1);
  CHECK(tally.ended_at_walls[0].name == ContactName{0, 3, 5});
  CHECK(tally.walls.durations.total() == 1);
  CHECK(tally.walls.durations.quantile(0.5) > tally.grains.durations.quantile(0.5));

  Tally both;
  both.merge(tally);
  both.merge(tally);
  CHECK(both.ended_at_walls.size() == 2);
  CHECK(both.grains.durations.total() == 2);
}

TEST_CASE("no contact with a smooth wall is cut short, however soon another grain ends it") {
  BrakeTally tally;
  tally.add(lasting_for(0.1 * t_col()), paper_model(), mass, true);
  CHECK(tally.contacts == 1);
  CHECK(tally.cut_short == 0);
  CHECK(tally.braking_cut_short.value() == 0.0);
}
