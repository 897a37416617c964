// The scenario of a column of beads: which drops a settings file asks for.
#include "engine/closed_forms.hpp"
#include "tests/scenarios/scenario_fixture.hpp"

using namespace scenario_fixture;
using Catch::Matchers::WithinRel;

namespace {

const std::string column_yaml = R"(
scenario: bead_column
contact: {stiffness: 2000 N/m, damping: 1e4 1/s}
)";

scenarios::ColumnCurve column(const Overrides& overrides = {}) {
  return std::get<scenarios::ColumnCurve>(scenarios::problem_of(read(column_yaml, overrides)));
}

}  // namespace

TEST_CASE("the beads of a column are those of the settings") {
  const auto c = column({"column.beads=7", "column.velocity=0.5 m/s", "grains.mass=2 mg"});
  CHECK(c.setup.beads == 7);
  CHECK(c.setup.velocity == 0.5);
  CHECK(c.setup.bead_mass == 2e-6);
  CHECK(c.setup.bead_radius == 0.5e-3);
}

TEST_CASE("the time step resolves the shorter contact, the gaps are measured by the longer one") {
  const auto c = column({"column.gap_ratio=[0.5, 2]"});
  const double plate = LinearContact{2000.0, 1e4, 1e-6}.collision_time();
  const double beads = LinearContact{2000.0, 1e4, 0.5e-6}.collision_time();
  CHECK_THAT(c.setup.time_step, WithinRel(beads / 50.0, 1e-12));
  REQUIRE(c.gap_ratios.size() == 2);
  CHECK_THAT(c.gap(c.gap_ratios[1]), WithinRel(2.0 * plate, 1e-12));
}

TEST_CASE("the limit of hard beads has the restitutions of both kinds of contacts") {
  const auto [name, attraction] =
      GENERATE(std::pair{"keep", Attraction::keep}, std::pair{"clip", Attraction::clip});
  const auto c = column({"column.beads=2", std::string("contact.attraction=") + name});
  const RigidColumn hard =
      rigid_column(2, LinearContact{2000.0, 1e4, 0.5e-6, attraction}.restitution(),
                   LinearContact{2000.0, 1e4, 1e-6, attraction}.restitution());
  CHECK(c.rigid.restitution == hard.restitution);
  CHECK(c.rigid.restitution > 0.0);
}

TEST_CASE("beads that sums do not hold are refused") {
  CHECK(complaint(column_yaml, {"grains.mass=1 t", "contact.stiffness=2e12"}) == "accepted");
  check_mentions(complaint(column_yaml, {"grains.mass=1e12 kg", "contact.stiffness=2e21"}),
                 {"grains.mass:", "sums over contacts", "units"});
  check_mentions(complaint(column_yaml, {"column.velocity=100 km/s"}),
                 {"column.velocity:", "sums over contacts"});
}

TEST_CASE("laws whose restitution is not known are refused") {
  check_mentions(
      complaint(column_yaml, {"contact.law=hertz", "contact.stiffness=1e5", "contact.damping=1"}),
      {"contact.law:", "depends on the speed", "choose linear"});
}
