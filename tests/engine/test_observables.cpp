// What is read off a state is what its definition says.
#include "engine/observables.hpp"
#include "tests/catch.hpp"
#include "tests/engine/systems.hpp"

#include <cmath>
#include <numbers>

using namespace systems;

namespace {

/// Two grains of unequal mass in a box of 10 mm.
State pair_of_grains(double gravity = 0.0) {
  State state = empty_box(10e-3, 20e-3);
  state.gravity.y = gravity;
  add_grain(state, {.x = 2e-3, .y = 3e-3, .vx = 1.0, .vy = 5.0, .radius = radius, .mass = 1e-6});
  add_grain(state, {.x = 8e-3, .y = 9e-3, .vx = -3.0, .vy = 1.0, .radius = radius, .mass = 2e-6});
  return state;
}

}  // namespace

TEST_CASE("means and spreads are over grains, not over mass") {
  const Observables o = observe(pair_of_grains());
  CHECK(o.mean_vx == Approx(-1.0));
  CHECK(o.mean_vy == Approx(3.0));
  CHECK(o.sigma_vx == Approx(2.0));
  CHECK(o.sigma_vy == Approx(2.0));
  CHECK(o.granular_temperature == Approx(4.0));
}

TEST_CASE("spins are in a mean over grains, and in a temperature with their radius and inertia") {
  State state = empty_box(10e-3, 20e-3);
  state.grains.inertia = sphere;
  add_grain(state, {2e-3, 3e-3, 0.0, 0.0, 0.5e-3, 1e-6, 300.0});
  add_grain(state, {8e-3, 9e-3, 0.0, 0.0, 1e-3, 2e-6, -100.0});
  const Observables o = observe(state);
  CHECK(o.mean_spin == Approx(100.0).epsilon(1e-9));
  // Surfaces at 0.15 m/s and 0.1 m/s
  CHECK(o.rotational_temperature == Approx(0.5 * sphere * (0.0225 + 0.01)).epsilon(1e-9));
  CHECK(o.energies.rotational
        == Approx(0.5 * sphere * (1e-6 * 0.0225 + 2e-6 * 0.01)).epsilon(1e-9));
  // Of the kick that the next step adds to a spin, half is there at the full step.
  state.grains.spin_kick[0] = nearest_fixed(40.0 * state.time_step / quantum_of_angle);
  CHECK(observe(state).mean_spin == Approx(110.0).epsilon(1e-9));
  CHECK(observe(state).rotational_temperature
        == Approx(0.5 * sphere * (0.0256 + 0.01)).epsilon(1e-9));
}

TEST_CASE("a start has its kinetic energy and nothing else") {
  State state = pair_of_grains();
  state.origin = origin_of(state);
  CHECK(state.origin.energy == Approx(0.5 * (1e-6 * 26.0 + 2e-6 * 10.0)));
  CHECK(state.origin.momentum_y == Approx(1e-6 * 5.0 + 2e-6 * 1.0));
  const Observables o = observe(state);
  CHECK(o.time == 0.0);
  CHECK(o.energies.kinetic == state.origin.energy);
  CHECK(o.energies.elastic == 0.0);
  CHECK(o.energies.gravity_work == 0.0);
  CHECK(o.energies.residual == 0.0);
  CHECK(o.contacts == 0.0);
}

TEST_CASE("a falling pair gains what gravity does") {
  State state = pair_of_grains(10.0);
  for (FixedVector& u : state.grains.u) u.x = 0;
  const State end = advanced(state, paper_model(), 100'000);  // 0.1 s
  const Energies e = observe(end).energies;
  const double t = 0.1, g = 10.0;
  CHECK(e.gravity_work == Approx(g * (7e-6 * t + 0.5 * 3e-6 * g * t * t)).epsilon(1e-8));
  CHECK(std::abs(e.residual) < 1e-8 * e.kinetic);  // g is rounded to a quantum
}

TEST_CASE("a pair falling at an angle gains what gravity does") {
  State state = pair_of_grains(10.0);
  state.gravity.x = -0.5;
  for (FixedVector& u : state.grains.u) u.x = 0;
  const State end = advanced(state, paper_model(), 50'000);  // 0.05 s
  const Energies e = observe(end).energies;
  const double t = 0.05, along = 10.0 * (7e-6 * t + 0.5 * 3e-6 * 10.0 * t * t);
  CHECK(e.gravity_work == Approx(along + 0.5 * 3e-6 * 0.25 * t * t).epsilon(1e-7));
  CHECK(std::abs(e.residual) < 1e-7 * e.kinetic);
}

TEST_CASE("the work of gravity is told after years between walls that hold it") {
  // A block of 14 kg, whose wall takes up what it gains, a thousandth of the time at once.
  constexpr double force = 140.0, years = 3e8, parts = 1000.0;  // N, s
  State state = empty_box(10e-3, 20e-3);
  state.gravity.y = 10.0;
  add_grain(state, {.x = 5e-3, .y = 3e-3, .vx = 0.0, .vy = 0.0, .radius = radius, .mass = 14.0});
  state.time_step = years / 1e15;
  state.step = static_cast<std::int64_t>(1e15);
  for (double part = 0.5; part < parts; ++part) {
    Contact contact{.name = {0, 0, 0}};
    contact.impulse_y = -force * years / parts;
    contact.impulse_y_times_time = contact.impulse_y * years * part / parts;
    state.tally.walls.add(contact);
  }
  // Nobody has moved.
  const double free_fall = 0.5 * force * 10.0 * years * years;
  CHECK(std::abs(observe(state).energies.gravity_work) < 1e-5 * free_fall);
}

TEST_CASE("grains beyond a wall line are counted as outside") {
  State state = pair_of_grains();
  add_walls(state, 10);
  CHECK(observe(state).outside == 0.0);
  add_grain(state, grain(-0.1e-3, 1e-3, 0.0, 0.0));
  add_grain(state, grain(10.1e-3, 1e-3, 0.0, 0.0));
  CHECK(observe(state).outside == 2.0);
}

TEST_CASE("grains are outside by where the walls are now") {
  // Both walls sway together by 2 mm, from their utmost left on.
  State state = empty_box(10e-3, 20e-3);
  add_walls(state, 10);
  const double frequency = 50.0;  // Hz
  for (WallLattice& wall : state.walls)
    wall.motion = {.amplitude_x = 2e-3, .frequency = frequency, .phase = -0.5 * std::numbers::pi};
  for (const double x : {5e-3, -1e-3, 11e-3}) add_grain(state, grain(x, 1e-3, 0.0, 0.0));
  CHECK(observe(state).outside == 1.0);
  CHECK(grain_outside(state) == 2);
  state.step = std::llround(0.5 / frequency / state.time_step);  // all have stood still
  CHECK(observe(state).outside == 1.0);
  CHECK(grain_outside(state) == 1);
}

TEST_CASE("where there is no wall no grain is outside") {
  State state = pair_of_grains();
  add_walls(state, 10);
  state.walls.pop_back();
  add_grain(state, grain(10.1e-3, 1e-3, 0.0, 0.0));
  CHECK(observe(state).outside == 0.0);
  add_grain(state, grain(-0.1e-3, 1e-3, 0.0, 0.0));
  CHECK(observe(state).outside == 1.0);
}

TEST_CASE("what contacts win is told, and is an error on top of what is missing") {
  State state = pair_of_grains();
  add_walls(state, 10);
  state.origin = origin_of(state);
  const auto contact = [](const ContactName& name, double normal_loss, double friction_loss) {
    Contact with_losses{.name = name};
    with_losses.normal_loss = normal_loss;
    with_losses.friction_loss = friction_loss;
    return with_losses;
  };
  state.tally.end(contact({no_wall, 0, 1}, -3e-9, 1e-9), 2.0 * radius);
  CHECK(state.tally.grains.energy_won.value() == Approx(2e-9));
  // What others lose does not make up for it.
  state.tally.end(contact({no_wall, 0, 1}, 11e-9, -1e-9), 2.0 * radius);
  CHECK(state.tally.grains.energy_won.value() == Approx(2e-9));
  state.tally.end(contact({0, 0, 0}, 1e-9, -2e-9), radius + wall_radius);
  CHECK(state.tally.walls.energy_won.value() == Approx(1e-9));
  state.contacts = {contact({no_wall, 0, 1}, -4e-9, 0.0)};
  const Energies e = observe(state).energies;
  CHECK(e.won == Approx(7e-9));
  CHECK(e.residual == Approx(-3e-9));  // losses of 3e-9 J, and all the energy still there
  CHECK(energy_error_ratio(state, e) == Approx(10e-9 / state.origin.energy));
}

TEST_CASE("lasting contacts count before they end") {
  State state = empty_box(10e-3, 20e-3);
  add_grain(state, grain(4e-3, 5e-3, 1.0, 0.0));
  add_grain(state, grain(5.001e-3, 5e-3, -1.0, 0.0));
  const State middle = advanced(state, paper_model(), 20);
  REQUIRE(middle.contacts.size() == 1);
  const Observables o = observe(middle);
  CHECK(o.contacts == 0.5);  // one for two grains
  CHECK(o.grain_contacts_begun == 1.0);
  CHECK(o.wall_contacts_begun == 0.0);
  CHECK(o.max_overlap == middle.contacts[0].max_overlap);
  const double xi = 1e-3 - (grain_of_id(middle, 1).x - grain_of_id(middle, 0).x);
  CHECK(o.energies.elastic == Approx(0.5 * stiffness * xi * xi).epsilon(1e-9));
  CHECK(o.energies.normal_loss > 0.0);
  CHECK(std::abs(o.energies.residual) < 0.02 * o.energies.normal_loss);
}

TEST_CASE("grains may fly an eighth of the shorter side in a step, and no faster than sums hold") {
  // m/s; the numbers of docs/reliability.md where there are many grains.
  CHECK(largest_speed({.width = 1e-2, .length = 2e-2}, 1e-6, 1) == Approx(1250.0));
  CHECK(largest_speed({.width = 2e-2, .length = 1e-2}, 1e-6, 1) == Approx(1250.0));
  CHECK(largest_speed({.width = 1.0, .length = 1.0}, 1e-6, 1'000'000)
        == Approx(260.0).epsilon(0.02));
  CHECK(largest_speed({.width = 1.0, .length = 1.0}, 1e-6, 10'000'000)
        == Approx(83.0).epsilon(0.02));
}

TEST_CASE("all work turns energy over, whatever its sign") {
  CHECK(energy_turned_over(1.0, -2.0, -4.0) == 7.0);
}

TEST_CASE("observables do not depend on the order of the slots") {
  const State state = advanced(small_tube(61), paper_model(), 400);
  const Observables a = observe(state), b = observe(shuffled(state, 9));
  CHECK(a.mean_vx == b.mean_vx);
  CHECK(a.mean_vy == b.mean_vy);
  CHECK(a.granular_temperature == b.granular_temperature);
  CHECK(a.energies.kinetic == b.energies.kinetic);
  CHECK(a.energies.elastic == b.energies.elastic);
  CHECK(a.energies.residual == b.energies.residual);
  CHECK(a.wall_impulse_y == b.wall_impulse_y);
}
