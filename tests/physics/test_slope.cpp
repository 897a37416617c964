// One grain and a smooth wall, with gravity at an angle: what mechanics says of impacts on a plane
// and of what slides or rolls down a slope.
#include "engine/closed_forms.hpp"
#include "engine/observables.hpp"
#include "engine/simulation.hpp"
#include "tests/catch.hpp"
#include "tests/engine/systems.hpp"

#include <cmath>
#include <numbers>

using namespace systems;

namespace {

constexpr double g = 10.0;  // m/s^2

State plane(double angle, double inertia) {
  State state = empty_box(10e-3, 20e-3);
  state.walls = {WallLattice::smooth_at(0.0)};
  state.gravity = {.x = -g * std::cos(angle), .y = g * std::sin(angle)};
  state.grains.inertia = inertia;
  return state;
}

/// m/s^2 along the slope, of a grain that has been put on it and has settled.
double acceleration_on_slope(double angle, double inertia, const ContactModel& model) {
  State state = plane(angle, inertia);
  add_grain(state, grain(radius, 5e-3, 0.0, 0.0));
  const State settled = advanced(state, model, 20'000);
  const State end = advanced(settled, model, 20'000);
  CHECK(end.contacts.size() == 1);
  return (grain_at(end, 0).vy - grain_at(settled, 0).vy) / (end.time() - settled.time());
}

/// A grain thrown against the plane, after the impact. Without gravity.
Grain after_impact(const ContactModel& model, double inertia, double vx, double vy) {
  State state = plane(0.0, inertia);
  state.gravity = {};
  add_grain(state, grain(radius + 1e-6, 5e-3, -vx, vy));
  const State end = advanced(state, model, 400);
  CHECK(end.tally.walls.ended == 1);
  return grain_at(end, 0);
}

}  // namespace

TEST_CASE("an impact on a plane has the restitution of eq. (4), whatever the speed along it") {
  const double vy = GENERATE(0.0, 0.7, 30.0);
  const LinearContact contact{stiffness, damping, mass};
  const Grain out = after_impact(frictionless(damping), 0.0, 0.5, vy);
  CHECK(out.vx == Approx(0.5 * contact.restitution()).epsilon(4e-3));
  CHECK(out.vy == Approx(vy).epsilon(1e-12));
}

TEST_CASE("an impact that slides on a plane takes mu times the normal impulse") {
  ContactModel model = paper_model();
  model.attraction = Attraction::clip;
  const double inertia = GENERATE(0.0, disc);
  const Grain out = after_impact(model, inertia, 0.5, 30.0);
  const double normal_impulse = mass * (0.5 + out.vx);
  CHECK(mass * (30.0 - out.vy) == Approx(friction * normal_impulse).epsilon(1e-3));
  if (inertia > 0.0)
    CHECK(inertia * mass * radius * out.spin == Approx(friction * normal_impulse).epsilon(0.02));
}

TEST_CASE("an impact that sticks to a plane lets a disc go rolling with two thirds of its speed") {
  const Grain out = after_impact(paper_model(), disc, 0.5, 0.2);
  CHECK(out.vy == Approx(0.2 * 2.0 / 3.0).epsilon(5e-3));
  CHECK(out.spin * radius == Approx(out.vy).epsilon(5e-3));
}

TEST_CASE("a grain without friction slides down a slope with g sin") {
  const double angle = GENERATE(0.1, 0.8);
  CHECK(acceleration_on_slope(angle, 0.0, frictionless(damping))
        == Approx(g * std::sin(angle)).epsilon(1e-4));
}

TEST_CASE("a grain that does not rotate slides down a steep slope with g (sin - mu cos)") {
  CHECK(acceleration_on_slope(0.8, 0.0, paper_model())
        == Approx(g * (std::sin(0.8) - friction * std::cos(0.8))).epsilon(1e-3));
}

TEST_CASE("discs and spheres roll down a slope with g sin / (1 + I / m r^2)") {
  const double inertia = GENERATE(disc, sphere);
  ContactModel model = paper_model();
  SECTION("capped slip") {}
  SECTION("tangential spring") { model.slip = SpringSlip{0.4 * stiffness, 0.3 * damping}; }
  CHECK(acceleration_on_slope(0.4, inertia, model)
        == Approx(g * std::sin(0.4) / (1.0 + inertia)).epsilon(2e-3));
}

TEST_CASE("a disc on a slope of more than three times mu slides") {
  ContactModel model = paper_model();
  model.friction = 0.1;
  CHECK(acceleration_on_slope(0.8, disc, model)
        == Approx(g * (std::sin(0.8) - 0.1 * std::cos(0.8))).epsilon(1e-3));
}

TEST_CASE("resistance to rolling on a plane counts with the radius of the grain") {
  ContactModel model = paper_model();
  model.rolling_friction = 0.1;
  CHECK(acceleration_on_slope(0.4, disc, model)
        == Approx(g * (std::sin(0.4) - 0.1 * std::cos(0.4)) / 1.5).epsilon(3e-3));
}

TEST_CASE("what rolls down a slope has all the work of gravity in its motion") {
  ContactModel model = paper_model();
  model.slip = SpringSlip{0.4 * stiffness, 0.3 * damping};
  State state = plane(0.4, disc);
  add_grain(state, grain(radius, 5e-3, 0.0, 0.0));
  const Energies e = observe(advanced(state, model, 100'000)).energies;
  CHECK(e.kinetic == Approx(2.0 * e.rotational).epsilon(2e-3));
  CHECK(e.kinetic + e.rotational == Approx(e.gravity_work).epsilon(2e-3));
  CHECK(std::abs(e.residual) < 1e-3 * e.gravity_work);
}
