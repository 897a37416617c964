// Grains that rotate: what friction and resistance to rolling do to their spins, against closed
// forms and the laws of conservation.
#include "engine/closed_forms.hpp"
#include "tests/catch.hpp"
#include "tests/physics/collisions.hpp"

#include <algorithm>
#include <cmath>

using namespace collisions;

namespace {

ContactModel elastic(const SlipLaw& slip, double mu) {
  ContactModel model = frictionless(0.0);
  model.slip = slip;
  model.friction = mu;
  return model;
}

/// Two unequal grains about to meet off centre, both spinning, along no axis.
State oblique_pair(double inertia) {
  State state = open_space(1e-6);
  state.grains.inertia = inertia;
  add_grain(state, {20e-3, 20e-3, 0.4, -0.1, radius, mass, 900.0});
  add_grain(state, {20.8e-3, 20.6e-3, -0.8, 0.1, 0.8 * radius, 0.6 * mass, -2500.0});
  return state;
}

/// kg m^2/s about the middle of the box: of the orbits, with velocities that have taken up the last
/// kick, and of the spins.
double angular_momentum(const State& state) {
  const Grains& g = state.grains;
  double sum = 0.0;
  for (std::size_t i = 0; i < g.size(); ++i) {
    const double x = state.box.metres_x(g.position[i].x) - 20e-3;
    const double y = state.box.place_y(g.position[i].y) - 20e-3;
    const double vx = state.box.metres_x(wrapped_sum(g.u[i].x, g.kick[i].x)) / state.time_step;
    const double vy = state.box.metres_y(wrapped_sum(g.u[i].y, g.kick[i].y)) / state.time_step;
    const double spin = static_cast<double>(wrapped_sum(g.spin[i], g.spin_kick[i]))
                        * quantum_of_angle / state.time_step;
    sum += g.mass[i] * (x * vy - y * vx + g.inertia * g.radius[i] * g.radius[i] * spin);
  }
  return sum;
}

}  // namespace

TEST_CASE("a pair conserves its angular momentum, orbit and spins together, to rounding") {
  ContactModel model = rolling_model();
  const SlipLaw slip = GENERATE(SlipLaw(CappedSlip{}), SlipLaw(LiteralSlip{}),
                                SlipLaw(ViscousSlip{3e4}), SlipLaw(SpringSlip{800.0, 1e4}));
  model.slip = slip;
  Simulation simulation(oblique_pair(GENERATE(disc, sphere)), model, 1);
  const double before = angular_momentum(simulation.state());
  const double scale = mass * radius * 1.0;  // of what is exchanged
  while (simulation.state().tally.grains.ended == 0) {
    simulation.advance(1);
    CHECK(std::abs(angular_momentum(simulation.state()) - before) < 1e-11 * scale);
    REQUIRE(simulation.state().step < 1000);
  }
  CHECK(std::abs(grain_of_id(simulation.state(), 0).spin - 900.0) > 100.0);
}

TEST_CASE("where friction slides, the spin takes up the torque of its impulse") {
  const double inertia = GENERATE(disc, sphere), mu = GENERATE(0.1, 0.5);
  const SlipLaw slip =
      GENERATE(SlipLaw(CappedSlip{}), SlipLaw(LiteralSlip{}), SlipLaw(SpringSlip{2e4, 0.0}));
  const State start = above_flat_wall(1.0, 8.0, step_of(0.0), inertia);
  const Outcome out = collide(start, elastic(slip, mu));
  const double impulse = mass * (8.0 - out.velocity.y());
  // A stiff spring is stretched before it slides.
  CHECK(impulse / (2.0 * mu * mass) == Approx(1.0).epsilon(1e-3));
  // The wall is at smaller x: friction against +y turns the grain from x towards y.
  CHECK(out.spin * inertia * mass * radius * radius
        == Approx(impulse * radius).epsilon(1e-3));  // the normal turns
}

TEST_CASE("an impact sticks or slides as Walton's rigid grains without tangential restitution") {
  // Slip left over: v_t - mu (1 + e) (1 + 1/c) v_n, or none; of a disc that sticks two thirds of
  // the velocity are left, of a sphere five sevenths.
  const double inertia = GENERATE(disc, sphere), mu = 0.2, e = 1.0;
  const double transition = mu * (1.0 + e) * (1.0 + 1.0 / inertia);  // tan of the angle
  const double tangent = GENERATE(0.3, 0.8, 0.97, 1.03, 1.2, 3.0) * transition;
  const State start = above_flat_wall(1.0, tangent, step_of(0.0), inertia);
  const Outcome out = collide(start, elastic(CappedSlip{}, mu));
  const double slip = out.velocity.y() - radius * out.spin;
  CHECK(slip == Approx(std::max(0.0, tangent - transition)).margin(2e-3));
  if (tangent < transition)
    CHECK(out.velocity.y() / tangent == Approx(1.0 / (1.0 + inertia)).epsilon(2e-3));
}

TEST_CASE("a spinning grain is thrown along the wall, and one that rolls rolls on") {
  const double speed = 2.0, inertia = GENERATE(disc, sphere);
  const ContactModel model = elastic(CappedSlip{}, 10.0);
  const Outcome thrown =
      collide(above_flat_wall(1.0, 0.0, step_of(0.0), inertia, -speed / radius), model);
  CHECK(thrown.velocity.y() == Approx(-speed * inertia / (1.0 + inertia)).epsilon(1e-3));
  const Outcome rolled =
      collide(above_flat_wall(1.0, speed, step_of(0.0), inertia, speed / radius), model);
  CHECK(rolled.velocity.y() == Approx(speed).epsilon(1e-4));
  CHECK(rolled.spin == Approx(speed / radius).epsilon(1e-4));
}

TEST_CASE("resistance to rolling takes mu_r R times the normal impulse, and never reverses") {
  ContactModel model = frictionless(0.0);
  model.rolling_friction = 0.2;
  const double inertia = GENERATE(disc, sphere);
  State state = open_space(1e-6);
  state.grains.inertia = inertia;
  const double first = GENERATE(3000.0, -3000.0, 20.0), second = 0.5 * first;
  add_grain(state, {20e-3, 20e-3, 0.5, 0.0, radius, mass, first});
  add_grain(state, {21.1e-3, 20e-3, -0.5, 0.0, radius, mass, second});
  const Outcome out = collide(state, model);
  const double impulse = mass * (0.5 - out.velocity.x());
  const double moment = inertia * mass * radius * radius;
  const double taken = std::min(0.2 * 0.5 * radius * impulse / moment, 0.25 * std::abs(first));
  CHECK(std::abs(first - out.spin) == Approx(taken).epsilon(1e-6));
  CHECK(out.spin + out.second_spin == Approx(first + second).epsilon(1e-9));
  CHECK(std::abs(out.spin - out.second_spin) < std::abs(first - second));
  // What is lost is what the spins have lost.
  const double energy = 0.5 * moment * (first * first + second * second)
                        - 0.5 * moment * (out.spin * out.spin + out.second_spin * out.second_spin);
  CHECK(out.tally.friction_loss.value() == Approx(energy).epsilon(1e-9));
}

TEST_CASE("a grain that touches nothing keeps its spin to the last bit") {
  State state = open_space(1e-6);
  state.gravity.y = 10.0;
  state.grains.inertia = disc;
  add_grain(state, {20e-3, 20e-3, 0.1, 0.2, radius, mass, 12345.678});
  const Stepping stepping = GENERATE(Stepping::plain, Stepping::windows);
  const State end = advanced(state, rolling_model(), 5000, 1, stepping);
  CHECK(end.grains.spin[0] == state.grains.spin[0]);
  CHECK(grain_at(end, 0).spin == Approx(12345.678).epsilon(1e-12));
}
