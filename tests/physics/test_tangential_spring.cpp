// The tangential spring of Cundall and Strack: impacts against an independent integrator and closed
// forms, and its energy.
#include "engine/closed_forms.hpp"
#include "engine/impact.hpp"
#include "engine/observables.hpp"
#include "tests/catch.hpp"
#include "tests/physics/collisions.hpp"
#include "tests/physics/reference_table.hpp"

#include <algorithm>
#include <cmath>

using namespace collisions;

namespace {

ContactModel model_of(const reference::Row& row) {
  return {LinearLaw{row("k"), row("gamma")}, SpringSlip{row("k_t"), row("gamma_t")}, row("mu"),
          Attraction::keep};
}

/// About to touch: body 2 is on its way for two steps and a part of one.
State start_of(const reference::Row& row, double dt, double phase) {
  State state = open_space(dt);
  state.grains.inertia = row("inertia");
  const bool at_wall = std::isinf(row("mass_1"));
  const double back = (2.0 + phase) * dt, middle = at_wall ? 0.0 : 20e-3;
  if (at_wall)
    state.walls = {{.line = 0.0, .radius = row("radius_1"), .count = 1}};
  else
    add_grain(state, {middle, middle, 0.0, 0.0, row("radius_1"), row("mass_1"), row("w_1")});
  add_grain(state, {middle + row("x") - back * row("vx"), middle + row("y") - back * row("vy"),
                    row("vx"), row("vy"), row("radius_2"), row("mass_2"), row("w_2")});
  return state;
}

/// How far the outcome is from that of the table: velocities, of centres and surfaces, as a part of
/// the speed.
double error_of(const reference::Row& row, double steps, double phase) {
  const Outcome out = collide(start_of(row, row("contact_time") / steps, phase), model_of(row));
  const bool at_wall = std::isinf(row("mass_1"));
  const Vector2d relative = at_wall ? out.velocity : Vector2d(out.second_velocity - out.velocity);
  const Vector2d expected(row("vx_after"), row("vy_after"));
  const double spin_1 = at_wall ? 0.0 : out.spin - row("w_1_after");
  const double spin_2 = (at_wall ? out.spin : out.second_spin) - row("w_2_after");
  const double speed = std::hypot(row("vx"), row("vy"));
  const bool turns = row("inertia") > 0.0;
  return std::max({(relative - expected).norm(), turns ? std::abs(spin_1) * row("radius_1") : 0.0,
                   turns ? std::abs(spin_2) * row("radius_2") : 0.0})
         / speed;
}

/// On a wall grain by a grain without spin: the velocity after, by the way that the scenarios of
/// single impacts go.
Vector2d velocity_after(const reference::Row& row, double inertia) {
  const double dt = row("contact_time") / 1000.0, back = 2.3 * dt;
  const ImpactSetup setup{.grain_radius = row("radius_2"),
                          .grain_mass = row("mass_2"),
                          .wall_grain_radius = row("radius_1"),
                          .wall_spacing = 0.0,
                          .model = model_of(row),
                          .inertia = inertia,
                          .collision_time = row("contact_time")};
  const ImpactResult result = follow(setup, {.x = row("x") - back * row("vx"),
                                             .y = row("y") - back * row("vy"),
                                             .v_x = -row("vx"),
                                             .v_y = row("vy"),
                                             .time_step = dt});
  REQUIRE(result.end == ImpactEnd::away);
  return {row("vx") + result.dv_x, row("vy") - result.dv_y};
}

double energy_of(const State& state) {
  const Energies e = observe(state).energies;
  return e.kinetic + e.rotational + e.elastic;
}

ContactModel elastic_spring(double k_t, double mu) {
  ContactModel model = frictionless(0.0);
  model.slip = SpringSlip{k_t, 0.0};
  model.friction = mu;
  return model;
}

/// The slip after an impact on a flat wall over that before, reversed.
double tangential_restitution(const ContactModel& model, double along, double inertia) {
  const double dt = LinearContact{stiffness, 0.0, mass}.collision_time() / 100.0;
  const Outcome out = collide(above_flat_wall(1.0, along, dt, inertia), model);
  return -(out.velocity.y() - radius * out.spin) / along;
}

}  // namespace

TEST_CASE("oblique impacts with a tangential spring are those of the reference") {
  int slide_and_stick = 0;
  for (const reference::Row& row : reference::table("spinning")) {
    CAPTURE(row("mass_1"), row("radius_1"), row("inertia"), row("k_t"), row("gamma_t"),
            row("gamma"), row("vx"), row("w_2"));
    CHECK(error_of(row, 1000.0, 0.3) < 5e-4);
    slide_and_stick += row("slides") + row("sticks") > 1.0;
  }
  CHECK(slide_and_stick > 20);
}

TEST_CASE("an impact on the wall is followed with the inertia of its grain") {
  int turning = 0;
  for (const reference::Row& row : reference::table("spinning")) {
    if (!std::isinf(row("mass_1")) || row("w_2") != 0.0) continue;
    const double inertia = row("inertia"), speed = std::hypot(row("vx"), row("vy"));
    CAPTURE(inertia, row("k_t"), row("gamma_t"), row("gamma"), row("vx"));
    const Vector2d expected(row("vx_after"), row("vy_after"));
    CHECK((velocity_after(row, inertia) - expected).norm() < 5e-4 * speed);
    if (inertia == 0.0) continue;
    CHECK((velocity_after(row, 0.0) - expected).norm() > 2e-2 * speed);
    ++turning;
  }
  CHECK(turning == 16);
}

TEST_CASE("impacts with a tangential spring converge at second order in the time step") {
  // In the mean over where the step falls. At first order where the normal force comes to pull
  // (gamma > 0): the limit passes zero within a step, and the spring is not cut off quite as short.
  const bool pulls = GENERATE(false, true);
  const auto mean_error = [&](double steps) {
    double sum = 0.0;
    int count = 0;
    for (const reference::Row& row : reference::table("spinning"))
      for (const double phase : {0.1, 0.4, 0.8}) {
        if ((row("gamma") > 0.0) != pulls) continue;
        sum += error_of(row, steps, phase);
        ++count;
      }
    return sum / count;
  };
  const double coarse = mean_error(50.0), fine = mean_error(400.0);
  CAPTURE(pulls, coarse, fine);
  CHECK(coarse < (pulls ? 1e-3 : 3e-4));
  CHECK(std::log2(coarse / fine) / 3.0 > (pulls ? 0.8 : 1.8));
}

TEST_CASE("a spring that sticks throws the slip back by the cosine of its phase") {
  const double inertia = GENERATE(0.0, disc, sphere);
  const double ratio = GENERATE(0.2, 0.6, 1.0, 1.5);  // of the frequencies
  const double softer = inertia > 0.0 ? 1.0 + 1.0 / inertia : 1.0;
  const double k_t = ratio * ratio * stiffness / softer;
  const double restitution = tangential_restitution(elastic_spring(k_t, 1e4), 0.3, inertia);
  CHECK(restitution == Approx(-std::cos(ratio * std::acos(-1.0))).margin(2e-3));
}

TEST_CASE("with equal frequencies the slip is reversed in full up to the angle of sliding") {
  // F_t / F_N is the same throughout: it slides if k_t v_t > mu k_n v_n.
  const double inertia = GENERATE(disc, sphere), mu = 0.3;
  const double softer = 1.0 + 1.0 / inertia, k_t = stiffness / softer;
  const ContactModel model = elastic_spring(k_t, mu);
  const double transition = mu * softer;  // tan of the angle
  CHECK(tangential_restitution(model, 0.5 * transition, inertia) == Approx(1.0).epsilon(1e-3));
  CHECK(tangential_restitution(model, 0.97 * transition, inertia) == Approx(1.0).epsilon(1e-3));
  CHECK(tangential_restitution(model, 1.2 * transition, inertia) < 0.95);
  // Far beyond it slides all the time: 2 mu m v_n along the wall.
  const double far = 10.0 * transition;
  CHECK(tangential_restitution(model, far, inertia)
        == Approx(2.0 * transition / far - 1.0).margin(2e-3));
}

TEST_CASE("no impact with a tangential spring wins energy on its way") {
  for (const reference::Row& row : reference::table("spinning")) {
    Simulation simulation(start_of(row, row("contact_time") / 400.0, 0.6), model_of(row), 1);
    const double start = energy_of(simulation.state());
    double lowest = start, rise = 0.0;
    for (int step = 0; step < 420; ++step) {
      simulation.advance(1);
      const double now = energy_of(simulation.state());
      rise = std::max(rise, now - lowest);
      lowest = std::min(lowest, now);
    }
    CAPTURE(row("mass_1"), row("inertia"), row("k_t"), row("gamma_t"), row("gamma"), row("vx"));
    CHECK(rise < 1e-3 * start);
    const Energies e = observe(simulation.state()).energies;
    CHECK(std::abs(e.residual) < 1e-3 * start);
    CHECK(e.friction_loss > -1e-4 * start);
    CHECK(e.elastic == 0.0);
  }
}

TEST_CASE("half a period of the spring shortens with the grains' freedom to turn") {
  CHECK(spring_time(SpringSlip{stiffness, 0.0}, 0.0, mass)
        == Approx(LinearContact{stiffness, 0.0, mass}.collision_time()));
  CHECK(spring_time(SpringSlip{stiffness, 0.0}, disc, mass)
        == Approx(LinearContact{stiffness, 0.0, mass}.collision_time() / std::sqrt(3.0)));
  CHECK(std::isinf(spring_time(CappedSlip{}, disc, mass)));
}
