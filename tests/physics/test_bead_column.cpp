// A column of soft beads dropped on a plate: against rigid beads where the gaps are wide, against
// an independent integrator where contacts couple the beads.
#include "engine/bead_column.hpp"
#include "engine/closed_forms.hpp"
#include "engine/rigid_column.hpp"
#include "tests/catch.hpp"
#include "tests/engine/systems.hpp"
#include "tests/physics/reference_table.hpp"

#include <cmath>

using namespace systems;

namespace {

LinearContact contact(double gamma, double reduced_mass) {
  return {stiffness, gamma, reduced_mass};
}

ColumnSetup column(int beads, double gamma, double steps_per_collision = 50.0) {
  return {.beads = beads,
          .bead_radius = radius,
          .bead_mass = mass,
          .velocity = 1.0,
          .model = {LinearLaw{stiffness, gamma}, CappedSlip{}, friction, Attraction::keep},
          .collision_time = contact(gamma, mass).collision_time(),
          .time_step = contact(gamma, 0.5 * mass).collision_time() / steps_per_collision};
}

ColumnResult drop_at(const ColumnSetup& setup, double gap_ratio,
                     Stepping stepping = Stepping::automatic) {
  return drop(setup, gap_ratio * setup.velocity * setup.collision_time, stepping);
}

RigidColumn rigid(const ColumnSetup& setup, double gamma) {
  return rigid_column(setup.beads, contact(gamma, 0.5 * mass).restitution(),
                      contact(gamma, mass).restitution());
}

}  // namespace

TEST_CASE("soft beads that are far apart collide as rigid ones, one after the other") {
  // Each contact is off by up to 1e-3 (tests/physics/test_head_on.cpp), of either sign.
  const int beads = GENERATE(1, 2, 5, 10);
  const double gamma = GENERATE(0.0, 2e3);
  CAPTURE(beads, gamma);
  const ColumnSetup setup = column(beads, gamma);
  const RigidColumn hard = rigid(setup, gamma);
  for (const double gap_ratio : {3.0, 30.0}) {
    const ColumnResult soft = drop_at(setup, gap_ratio);
    CAPTURE(gap_ratio);
    CHECK(soft.over);
    CHECK(soft.contacts == static_cast<double>(hard.collisions));
    CHECK(std::abs(soft.restitution - hard.restitution) < 3e-3);
    CHECK(std::abs(soft.rebound - hard.rebound) < 3e-3);
  }
}

TEST_CASE("beads of which several touch at once do as in the reference") {
  // At a tenth of the step what is left is of second order, or a contact end amiss by a hair.
  const bool fine = GENERATE(false, true);
  const auto rows = reference::table("bead_column");
  CHECK(rows.size() == 16);
  for (const reference::Row& row : rows) {
    const ColumnSetup setup =
        column(static_cast<int>(row("beads")), row("gamma"), fine ? 500.0 : 50.0);
    CAPTURE(fine, row("beads"), row("gamma"), row("gap_ratio"));
    const ColumnResult soft = drop(setup, row("gap"));
    const double tolerance = fine ? 3e-4 : 6e-3;
    CHECK(soft.over);
    CHECK(std::abs(soft.restitution - row("restitution")) < tolerance);
    CHECK(std::abs(soft.rebound - row("rebound")) < tolerance);
    CHECK(std::abs(soft.max_overlap / row("max_overlap") - 1.0) < tolerance);
    if (fine) CHECK(soft.contacts == row("contacts"));
  }
}

TEST_CASE("beads that stand close keep energy that hard ones lose") {
  // The detachment effect: the longer the contacts last, the more.
  const double gamma = 2e3;
  const ColumnSetup setup = column(10, gamma);
  double kept = rigid(setup, gamma).restitution;
  for (const double gap_ratio : {0.7, 0.4, 0.2, 0.05}) {
    const double now = drop_at(setup, gap_ratio).restitution;
    CHECK(now > 1.02 * kept);
    kept = now;
  }
}

TEST_CASE("elastic beads lose no energy, but those that touch at once part") {
  const ColumnResult elastic = drop_at(column(8, 0.0, 200.0), 0.05);
  CHECK(std::abs(elastic.restitution - 1.0) < 1e-4);
  CHECK(elastic.rebound < 0.99);
}

TEST_CASE("a drop that goes through the plate is given up at once") {
  ColumnSetup setup = column(10, 2e3);
  setup.velocity = 100.0;
  const ColumnResult through = drop_at(setup, 30.0);
  CHECK_FALSE(through.over);
  CHECK(through.steps < 100'000);  // patience would last for millions
}

TEST_CASE("a column falls the same by windows and plainly") {
  const double gap_ratio = GENERATE(0.03, 0.5, 20.0);
  const ColumnSetup setup = column(6, 2e3);
  const ColumnResult plain = drop_at(setup, gap_ratio, Stepping::plain);
  const ColumnResult windows = drop_at(setup, gap_ratio, Stepping::windows);
  CHECK(hash_of({plain}) == hash_of({windows}));
}

TEST_CASE("drops do not depend on the number of threads") {
  const ColumnSetup setup = column(4, 2e3);
  const std::vector<double> gaps = {1e-6, 1e-5, 5e-5, 2e-4, 1e-3};
  CHECK(hash_of(drop_all(setup, gaps, 1)) == hash_of(drop_all(setup, gaps, 3)));
}
