// The two scenarios of single impacts: which impacts a settings file asks for.
#include "engine/closed_forms.hpp"
#include "tests/scenarios/scenario_fixture.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace scenario_fixture;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double reach = 0.83e-3;  // m, sum of the radii of 1 mm and 0.66 mm
const double t_col = std::numbers::pi / std::sqrt(2000.0 / 1e-6 - 0.25e8);  // s, eq. (4)

}  // namespace

TEST_CASE("a single wall grain meets one grazing impact for each axial velocity") {
  const auto c = curve(single_yaml);
  CHECK(c.setup.single_wall_grain());
  CHECK_THAT(c.setup.collision_time, WithinRel(t_col, 1e-12));
  REQUIRE(c.points.size() == 60);
  REQUIRE(c.impacts.size() == 60);
  CHECK(c.points.front().v_y == 0.1);
  CHECK(c.points.back().v_y == 40.0);
  for (std::size_t i = 0; i < c.points.size(); ++i) {
    CHECK(c.points[i].first_impact == i);
    CHECK(c.points[i].impacts == 1);
    CHECK(c.impacts[i].v_x == 0.0);
    CHECK(c.impacts[i].v_y == c.points[i].v_y);
    CHECK(c.impacts[i].x == 0.82e-3);
  }
}

TEST_CASE("a grazing grain starts upstream, just out of the wall grain's reach") {
  for (const Impact& impact : curve(single_yaml).impacts) {
    CHECK(impact.y < 0.0);
    const double distance = std::hypot(impact.x, impact.y);
    CHECK(distance >= reach);
    CHECK(distance < 1.01 * reach);
  }
}

TEST_CASE("a wall array meets all starts of all pairs of velocities") {
  const auto c = curve(array_yaml, {"impact.starts=4", "impact.normal_velocity=[0.2, 0.4]",
                                    "impact.axial_velocity=[1, 2, 3]"});
  CHECK(c.setup.wall_spacing == 0.66e-3);
  REQUIRE(c.points.size() == 6);
  REQUIRE(c.impacts.size() == 24);
  for (std::size_t i = 0; i < c.points.size(); ++i) {
    const auto& point = c.points[i];
    CHECK(point.v_x == (i < 3 ? 0.2 : 0.4));
    CHECK(point.v_y == static_cast<double>(i % 3 + 1));
    CHECK(point.first_impact == 4 * i);
    REQUIRE(point.impacts == 4);
    for (std::size_t start = 0; start < 4; ++start) {
      const Impact& impact = c.impacts[point.first_impact + start];
      CHECK(impact.v_x == point.v_x);
      CHECK(impact.v_y == point.v_y);
      CHECK_THAT(impact.y, WithinAbs(static_cast<double>(start) * 0.66e-3 / 4.0, 1e-15));
    }
  }
}

TEST_CASE("the wall array's defaults are the paper's three curves of 60 points and 10 starts") {
  const auto c = curve(array_yaml);
  CHECK(c.points.size() == 180);
  CHECK(c.impacts.size() == 1800);
  for (const Impact& impact : c.impacts) CHECK_THAT(impact.x, WithinAbs(reach, 1e-18));
}

TEST_CASE("the time step resolves the collision, and the passage where that is shorter") {
  SECTION("of a single wall grain, at the impact height") {
    const double path = 2.0 * std::sqrt(reach * reach - 0.82e-3 * 0.82e-3);
    for (const Impact& impact : curve(single_yaml, {"run.steps_per_collision=30"}).impacts) {
      CHECK_THAT(impact.time_step, WithinRel(std::min(t_col, path / impact.v_y) / 30.0, 1e-12));
    }
  }
  SECTION("of an array, as deep as the normal velocity drives the grain in") {
    for (const Impact& impact : curve(array_yaml).impacts) {
      const double height = reach - impact.v_x * t_col / std::numbers::pi;
      const double path = 2.0 * std::sqrt(reach * reach - height * height);
      CHECK_THAT(impact.time_step, WithinRel(std::min(t_col, path / impact.v_y) / 50.0, 1e-12));
    }
  }
}

TEST_CASE("a height at which the grain would miss the wall grain is refused") {
  const std::string height = GENERATE("0.83 mm", "2 mm");
  check_mentions(
      complaint(single_yaml, {"impact.height=" + height}),
      {"--set impact.height=" + height, "impact.height:", "without touching", "0.00083 m"});
}

TEST_CASE("a height at which the grain would overlap the array from the start is refused") {
  check_mentions(complaint(array_yaml, {"impact.height=0.82 mm"}),
                 {"--set impact.height=0.82 mm", "impact.height:", "overlap", "0.00083 m"});
  CHECK(complaint(array_yaml, {"impact.height=0.83 mm"}) == "accepted");
  CHECK(complaint(array_yaml, {"impact.height=1.5 mm"}) == "accepted");
}

TEST_CASE("a height of another unit is refused, before the box is left") {
  CHECK(complaint(array_yaml, {"impact.height=53 mm"}) == "accepted");
  check_mentions(complaint(array_yaml, {"impact.height=0.83"}),
                 {"--set impact.height=0.83", "impact.height:", "too far from the wall", "0.0531 m",
                  "unit forgotten"});
}

TEST_CASE("more impacts than a summary holds are refused") {
  const std::string many = "{from: 0.1 m/s, to: 1 m/s, points: 300, spacing: linear}";
  check_mentions(
      complaint(array_yaml, {"impact.normal_velocity=" + many, "impact.axial_velocity=" + many}),
      {"impact.axial_velocity:", "90000 points", "more than 50000"});
  check_mentions(complaint(array_yaml, {"impact.normal_velocity=" + many, "impact.starts=10000"}),
                 {"impact.starts:", "impacts in", "more than 10000000"});
}

TEST_CASE("impacts that sums do not hold are refused") {
  for (const std::string& yaml : {single_yaml, array_yaml})
    check_mentions(complaint(yaml, {"grains.mass=1e15 kg", "contact.stiffness=2e24"}),
                   {"grains.mass:", "sums over contacts"});
  check_mentions(complaint(single_yaml, {"impact.axial_velocity=[1 m/s, 1000 km/s]"}),
                 {"impact.axial_velocity:", "sums over contacts"});
}
