// Impacts on the wall against the tables of an independent, adaptive integrator.
//
// Time steps of min(t_col, chord / v_y) / 50, as a user has them, and a tenth of that. The errors
// are of second order for eq. (1), so that the tolerances of the two differ by about a hundred.
#include "tests/catch.hpp"
#include "tests/physics/impacts.hpp"
#include "tests/physics/reference_table.hpp"

#include <cmath>
#include <string>

using namespace impacts;

namespace {

ImpactResult as_in(const reference::Row& row, const ImpactSetup& setup, double steps) {
  return follow(setup, {.x = impact_height,
                        .y = -0.13e-3,
                        .v_x = 0.0,
                        .v_y = row("v_y"),
                        .time_step = resolving_time_step(setup.collision_time, impact_height,
                                                         row("v_y"), steps)});
}

void check_impact(const ImpactResult& result, const reference::Row& row, double tolerance) {
  CAPTURE(row("v_y"));
  CHECK(std::abs(result.dv_x / row("dv_x") - 1.0) < tolerance);
  CHECK(std::abs(result.dv_y / row("dv_y") - 1.0) < tolerance);
  CHECK(std::abs(result.contact_time / row("contact_time") - 1.0) < tolerance);
  CHECK(std::abs(result.max_overlap / row("max_overlap") - 1.0) < tolerance);
  CHECK(result.contacts == row("contacts"));
  CHECK(result.end == ImpactEnd::away);
}

std::string name(ImpactEnd end) {
  if (end == ImpactEnd::away) return "away";
  return end == ImpactEnd::passed ? "passed" : "stuck";
}

}  // namespace

TEST_CASE("a grain that grazes one wall grain does as in the reference") {
  // 1e-3: (pi/50)^2/24 = 2e-4 with factors of order one, and the largest sampled overlap lacks up
  // to (pi/100)^2/2 = 5e-4. A hundredth of that at a tenth of the step.
  const bool fine = GENERATE(false, true);
  const auto rows = reference::table("single_wall_grain");
  CHECK(rows.size() == 80);
  for (const reference::Row& row : rows) {
    ContactModel model = paper_model();
    model.normal = LinearLaw{stiffness, row("gamma")};
    const double t_col = LinearContact{stiffness, row("gamma"), mass}.collision_time();
    check_impact(as_in(row, single_wall_grain(model, t_col), fine ? 500.0 : 50.0), row,
                 fine ? 2e-5 : 1e-3);
  }
}

TEST_CASE("a grain that grazes one wall grain does as in the reference under Hertz's law") {
  // The damping begins and ends like a square root, so that the error is of order 3/2.
  const bool fine = GENERATE(false, true);
  const auto rows = reference::table("single_wall_grain_hertz");
  CHECK(rows.size() == 15);
  for (const reference::Row& row : rows) {
    ContactModel model = paper_model();
    model.normal = HertzKuwabaraKonoLaw{5e5, row("gamma")};
    const double t_col = collision_time(model.normal, mass, 1.0);
    check_impact(as_in(row, single_wall_grain(model, t_col), fine ? 500.0 : 50.0), row,
                 fine ? 4e-4 : 8e-3);
  }
}

TEST_CASE("every impact on the wall array ends as in the reference") {
  // At a tenth of the step the error is of second order in the velocities at stake, 2e-5 m/s, and
  // no contact is missed. At 50 steps a contact that begins or ends within a hair of a full step
  // may have half a step of damping too much, 0.7 % of its velocity; and a grazing contact shorter
  // than a step may be missed: it costs little itself, but the contacts after it begin
  // elsewhere, 2.5e-4 v_y.
  const bool fine = GENERATE(false, true);
  const ImpactSetup setup = wall_array(paper_model(), wall_collision_time());
  int rows = 0, other_counts = 0;
  for (const reference::Row& row : reference::table("wall_array")) {
    const double v_x = row("v_x"), v_y = row("v_y");
    CAPTURE(v_x, v_y, row("start"));
    const ImpactResult result =
        follow(setup, {.x = reach,
                       .y = row("start") * spacing / 10.0,
                       .v_x = v_x,
                       .v_y = v_y,
                       .time_step = resolving_time_step(setup.collision_time, impact_height, v_y,
                                                        fine ? 500.0 : 50.0)});
    const double tolerance =
        fine ? 2e-5 : 0.01 * std::hypot(row("dv_x"), row("dv_y")) + 2.5e-4 * v_y;
    CHECK(std::abs(result.dv_y - row("dv_y")) < tolerance);
    CHECK(std::abs(result.dv_x - row("dv_x")) < tolerance);
    CHECK(name(result.end) == row.text("end_state"));
    CHECK(std::abs(result.contacts - row("contacts")) <= (fine ? 0.0 : 1.0));
    ++rows;
    other_counts += result.contacts != row("contacts");
  }
  CHECK(rows == 360);
  CHECK(other_counts <= (fine ? 0 : 3));
}
