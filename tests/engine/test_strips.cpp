// What stands in the strips of a tube, against brute force and by hand.
#include "engine/present_forces.hpp"
#include "engine/strips.hpp"
#include "tests/catch.hpp"
#include "tests/engine/systems.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace systems;

namespace {

double value(const std::vector<double>& sums, std::size_t strip, StripSum which) {
  return sums[Strips::column(strip, which)];
}

double total(const std::vector<double>& sums, const Strips& strips, StripSum which) {
  double sum = 0.0;
  for (std::size_t strip = 0; strip < strips.count; ++strip) sum += value(sums, strip, which);
  return sum;
}

/// m^2, of the disc within left <= x <= right: Simpson's rule after x = r sin(angle).
double area_between(const Grain& g, double left, double right) {
  const auto angle = [&](double x) {
    return std::asin(std::clamp((x - g.x) / g.radius, -1.0, 1.0));
  };
  const double from = angle(left), to = angle(right);
  constexpr int pieces = 200;
  const double h = (to - from) / pieces;
  double sum = 0.0;
  for (int i = 0; i <= pieces; ++i) {
    const double weight = i == 0 || i == pieces ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
    const double c = std::cos(from + i * h);
    sum += weight * 2.0 * g.radius * g.radius * c * c;
  }
  return sum * h / 3.0;
}

/// The part of the line from a to b that lies within left <= x < right.
double part_within(double a, double b, double left, double right) {
  const auto [low, high] = std::minmax(a, b);
  return std::max(0.0, std::min(high, right) - std::max(low, left)) / (high - low);
}

/// Two grains of the paper, the second `distance` from the first at `angle`, at rest or approaching
/// along their line; they have touched for long.
State touching(double x, double y, double distance, double angle, double approach = 0.0) {
  State state = empty_box(10e-3, 20e-3);
  const double nx = std::cos(angle), ny = std::sin(angle);
  const double v = 0.5 * approach;
  add_grain(state, grain(x, y, v * nx, v * ny));
  add_grain(state, grain(x + distance * nx, y + distance * ny, -v * nx, -v * ny));
  state.contacts = {{.name = {no_wall, 0, 1}}};
  return state;
}

/// A crowded tube in a moment with contacts of several grains.
State busy_tube(std::uint64_t seed, const ContactModel& model, double inertia = 0.0) {
  Simulation simulation(small_tube(seed, 40, inertia), model, 1);
  do simulation.advance(100);
  while (simulation.state().step < 10'000 && simulation.state().contacts.size() < 4);
  REQUIRE(simulation.state().contacts.size() >= 4);
  return simulation.state();
}

constexpr double overlap = 1e-5;  // m

}  // namespace

TEST_CASE("the area of a disc left of a line has its closed form") {
  const double r = 0.7, whole = std::numbers::pi * r * r;
  CHECK(area_left_of(-r, r) == 0.0);
  CHECK(area_left_of(-2.0 * r, r) == 0.0);
  CHECK(area_left_of(0.0, r) == Approx(0.5 * whole));
  CHECK(area_left_of(r, r) == Approx(whole));
  CHECK(area_left_of(3.0 * r, r) == Approx(whole));
  for (int i = -50; i <= 50; ++i) {
    const double h = 0.02 * i;
    const double exact = std::numbers::pi - std::acos(h) + h * std::sqrt(1.0 - h * h);
    CHECK(std::abs(area_left_of(h * r, r) / (r * r) - exact) < 3e-8);
  }
  // The segment beyond half the radius: r^2 (pi/3 - sqrt(3)/4)
  CHECK(area_left_of(-0.5 * r, r)
        == Approx(r * r * (std::numbers::pi / 3.0 - std::sqrt(3.0) / 4.0)));
}

TEST_CASE("strips are about a mean diameter wide and cover the tube") {
  const State state = small_tube(71);
  const Strips strips = Strips::of(state);
  CHECK(strips.count == 8);
  CHECK(strips.width * static_cast<double>(strips.count) == Approx(state.box.width));
  CHECK(strips.at(-1.0) == 0);
  CHECK(strips.at(1.0) == 7);
  CHECK(strips.at(1.5e-3) == 1);
  CHECK(strips.middles()[1] == Approx(1.5e-3));
}

TEST_CASE("the strips of a tube hold what brute force finds there") {
  const auto seed = GENERATE(as<std::uint64_t>{}, 71, 72, 73);
  const State state = busy_tube(seed, paper_model(), GENERATE(0.0, disc));
  const Frame frame{.vx = 0.3, .vy = 1.7};
  for (const std::size_t count : {1U, 3U, 8U, 50U}) {  // some finer than a grain
    const Strips strips{.width = state.box.width / static_cast<double>(count),
                        .length = state.box.length,
                        .count = count};
    const auto sums = sum_over_strips(strips, state, paper_model(), frame);
    REQUIRE(sums.size() == strips.columns());
    for (std::size_t s = 0; s < count; ++s) {
      const double left = static_cast<double>(s) * strips.width, right = left + strips.width;
      const double middle = 0.5 * (left + right);
      double area = 0.0, grains = 0.0, u2 = 0.0, w2 = 0.0, z2 = 0.0, zw = 0.0, spin = 0.0,
             turning = 0.0, rotation = 0.0, mass_vx_w = 0.0, mass_z = 0.0, mass_zw = 0.0, xx = 0.0,
             xy = 0.0, yx = 0.0, yy = 0.0;
      for (std::size_t slot = 0; slot < state.grains.size(); ++slot) {
        const Grain g = grain_at(state, slot);
        area += area_between(g, left, right);
        if (g.x < left || g.x >= right) continue;
        grains += 1.0;
        const double u = g.vx - frame.vx, w = g.vy - frame.vy, z = (g.x - middle) / strips.width;
        u2 += u * u;
        w2 += w * w;
        z2 += z * z;
        zw += z * w;
        if (state.grains.rotate()) {
          spin += g.spin;
          turning += disc * g.radius * g.radius * g.spin;
          rotation += disc * g.radius * g.radius * g.spin * g.spin;
        }
        mass_vx_w += g.mass * g.vx * w;
        mass_z += g.mass * z;
        mass_zw += g.mass * z * w;
      }
      for (const PresentForce& f : present_forces(state, paper_model())) {
        const double part = part_within(f.x, f.x - f.branch_x, left, right);
        xx += part * f.branch_x * f.fx;
        xy += part * f.branch_x * f.fy;
        yx += part * f.branch_y * f.fx;
        yy += part * f.branch_y * f.fy;
      }
      CHECK(value(sums, s, StripSum::area) == Approx(area).epsilon(1e-6).margin(1e-15));
      CHECK(value(sums, s, StripSum::grains) == grains);
      CHECK(value(sums, s, StripSum::u2) == Approx(u2));
      CHECK(value(sums, s, StripSum::w2) == Approx(w2));
      CHECK(value(sums, s, StripSum::z2) == Approx(z2));
      CHECK(value(sums, s, StripSum::zw) == Approx(zw).margin(1e-9));
      CHECK(value(sums, s, StripSum::spin) == Approx(spin).margin(1e-6));
      CHECK(value(sums, s, StripSum::gyration2_spin) == Approx(turning).margin(1e-12));
      CHECK(value(sums, s, StripSum::gyration2_spin2) == Approx(rotation));
      CHECK(value(sums, s, StripSum::mass_vx_w) == Approx(mass_vx_w).margin(1e-15));
      CHECK(value(sums, s, StripSum::mass_z) == Approx(mass_z).margin(1e-15));
      CHECK(value(sums, s, StripSum::mass_zw) == Approx(mass_zw).margin(1e-15));
      CHECK(value(sums, s, StripSum::contact_xx) == Approx(xx).margin(1e-13));
      CHECK(value(sums, s, StripSum::contact_xy) == Approx(xy).margin(1e-13));
      CHECK(value(sums, s, StripSum::contact_yx) == Approx(yx).margin(1e-13));
      CHECK(value(sums, s, StripSum::contact_yy) == Approx(yy).margin(1e-13));
    }
  }
}

TEST_CASE("where there is no wall, what lies beyond the strips is in none") {
  State state = empty_box(4e-3, 10e-3);
  add_grain(state, grain(3.2e-3, 2e-3, 0.1, 1.0));
  add_grain(state, grain(4.0e-3 + 0.2 * radius, 5e-3, 0.2, 2.0));  // reaches into the last strip
  add_grain(state, grain(6e-3, 8e-3, 0.3, 3.0));
  const auto sums_with_walls = [&](std::size_t walls) {
    state.walls = std::vector(walls, WallLattice{.line = 0.0, .radius = 0.0, .count = 0});
    return sum_over_strips(Strips::of(state), state, paper_model(), {});
  };
  const auto closed = sums_with_walls(2), open = sums_with_walls(1);
  REQUIRE(open.size() == closed.size());
  CHECK(value(closed, 3, StripSum::grains) == 3.0);
  CHECK(value(open, 3, StripSum::grains) == 1.0);
  CHECK(value(open, 3, StripSum::vy) == Approx(1.0));
  const double inside = area_left_of(-0.2 * radius, radius);
  CHECK(value(open, 3, StripSum::area) + value(open, 2, StripSum::area)
        == Approx(std::numbers::pi * radius * radius + inside));
}

TEST_CASE("all strips together hold all grains, all their area and the whole virial") {
  const State state = busy_tube(74, paper_model());
  const Strips strips = Strips::of(state);
  const auto sums = sum_over_strips(strips, state, paper_model(), {});
  double area = 0.0, momentum = 0.0, energy = 0.0, velocity = 0.0, virial = 0.0;
  for (std::size_t slot = 0; slot < state.grains.size(); ++slot) {
    const Grain g = grain_at(state, slot);
    area += std::numbers::pi * g.radius * g.radius;
    momentum += g.mass * g.vy;
    energy += g.mass * (g.vx * g.vx + g.vy * g.vy);
    velocity += g.vy;
  }
  for (const PresentForce& f : present_forces(state, paper_model()))
    virial += f.branch_x * f.fx + f.branch_y * f.fy;
  CHECK(total(sums, strips, StripSum::grains) == 40.0);
  CHECK(total(sums, strips, StripSum::area) == Approx(area).epsilon(1e-12));
  CHECK(total(sums, strips, StripSum::mass_w) == Approx(momentum).epsilon(1e-12));
  CHECK(total(sums, strips, StripSum::vy) == Approx(velocity).epsilon(1e-12));
  CHECK(total(sums, strips, StripSum::mass_vx2) + total(sums, strips, StripSum::mass_w2)
        == Approx(energy).epsilon(1e-12));
  CHECK(total(sums, strips, StripSum::contact_xx) + total(sums, strips, StripSum::contact_yy)
        == Approx(virial).epsilon(1e-12));
}

TEST_CASE("the sums over strips are the same bits for any order, threads and stepping") {
  const State start = small_tube(75);
  const Strips strips = Strips::of(start);
  const auto sums_of = [&](const State& state) {
    return sum_over_strips(strips, state, paper_model(), {.vx = 0.5, .vy = 2.0});
  };
  const State one = busy_tube(75, paper_model());
  const auto expected = sums_of(one);
  CHECK(sums_of(shuffled(one, 5)) == expected);
  CHECK(sums_of(advanced(start, paper_model(), one.step, 1, Stepping::plain)) == expected);
  CHECK(sums_of(advanced(start, paper_model(), one.step, 3, Stepping::plain)) == expected);
  CHECK(sums_of(advanced(start, paper_model(), one.step, 1, Stepping::windows)) == expected);
}

TEST_CASE("two grains in contact have the virial of their force times their distance") {
  const double d = 2.0 * radius - overlap, force = stiffness * overlap;
  const double angle = GENERATE(0.0, 0.5, 1.0, 2.0, 4.0);
  const double nx = std::cos(angle), ny = std::sin(angle);
  const State state = touching(5.5e-3, 10e-3, d, angle);
  const Strips all{.width = 10e-3, .length = 20e-3, .count = 1};
  const auto sums = sum_over_strips(all, state, frictionless(0.0), {});
  CHECK(value(sums, 0, StripSum::contact_xx) == Approx(d * force * nx * nx).margin(1e-15));
  CHECK(value(sums, 0, StripSum::contact_xy) == Approx(d * force * nx * ny).margin(1e-15));
  CHECK(value(sums, 0, StripSum::contact_yx) == Approx(d * force * nx * ny).margin(1e-15));
  CHECK(value(sums, 0, StripSum::contact_yy) == Approx(d * force * ny * ny).margin(1e-15));
}

TEST_CASE("the line between two grains is shared by the strips that it crosses") {
  const double d = 2.0 * radius - overlap, virial = d * stiffness * overlap;
  const State across = touching(2.7e-3, 10e-3, d, 0.0);  // from 2.7 mm to 3.69 mm
  const Strips strips = Strips::of(across);
  REQUIRE(strips.count == 10);
  const auto sums = sum_over_strips(strips, across, frictionless(0.0), {});
  CHECK(value(sums, 2, StripSum::contact_xx) == Approx(virial * 0.3e-3 / d));
  CHECK(value(sums, 3, StripSum::contact_xx) == Approx(virial * (d - 0.3e-3) / d));
  CHECK(total(sums, strips, StripSum::contact_xx) == Approx(virial));

  // Along the tube, and across its seam
  const State along = touching(2.7e-3, 19.8e-3, d, 0.5 * std::numbers::pi);
  const auto of_one = sum_over_strips(strips, along, frictionless(0.0), {});
  CHECK(value(of_one, 2, StripSum::contact_yy) == Approx(virial));
  CHECK(total(of_one, strips, StripSum::contact_yy) == Approx(virial));
}

TEST_CASE("damping and friction are in the forces") {
  // Approaching at 0.1 m/s: F_N = k xi + gamma m_red v. Both also move at 1 m/s across their line
  // relative to each other: F_S = mu F_N against it.
  State state = touching(5e-3, 10e-3, 2.0 * radius - overlap, 0.0, 0.1);
  const Fixed sideways = nearest_fixed(0.5 * state.time_step / state.box.quantum_y());
  state.grains.u[0].y = sideways;
  state.grains.u[1].y = -sideways;
  const auto forces = present_forces(state, paper_model());
  REQUIRE(forces.size() == 1);
  const double normal = stiffness * overlap + damping * 0.5 * mass * 0.1;
  CHECK(forces[0].fx == Approx(-normal).epsilon(1e-6));
  CHECK(forces[0].fy == Approx(-friction * normal).epsilon(1e-6));
}

TEST_CASE("spins of tiny grains are summed up beyond the range of exact sums") {
  State state = empty_box(10e-3, 20e-3);
  state.time_step = 1e-12;
  for (const double y : {5e-3, 10e-3}) add_grain(state, grain(5e-3, y, 0.0, 0.0));
  state.grains.radius = {1e-8, 1e-8};  // m
  state.grains.inertia = disc;
  state.grains.resize(2);
  constexpr double spin = 1.2e11;  // rad/s; an ExactSum holds 1.37e11
  const Fixed per_step = nearest_fixed(spin * state.time_step / quantum_of_angle);
  state.grains.spin = {per_step, per_step};
  const Strips strips{.width = 10e-3, .length = 20e-3, .count = 1};
  const auto sums = sum_over_strips(strips, state, paper_model(), {});
  CHECK(value(sums, 0, StripSum::spin) == Approx(2.0 * spin));
}

TEST_CASE("the friction of grains that turn is against the slip of their surfaces") {
  // Both turn from x towards y, and neither moves: where they touch, the surface of the first goes
  // up and that of the second down.
  const double sense = GENERATE(1.0, -1.0);
  State state = touching(5e-3, 10e-3, 2.0 * radius - overlap, 0.0);
  const auto along = [&] { return present_forces(state, paper_model()).at(0).fy; };
  CHECK(along() == 0.0);
  state.grains.inertia = disc;
  state.grains.resize(2);
  const Fixed spin = nearest_fixed(sense * 1000.0 * state.time_step / quantum_of_angle);
  state.grains.spin = {spin, spin};
  CHECK(along() == Approx(-sense * friction * stiffness * overlap));
  CHECK(present_forces(state, paper_model()).at(0).fx == Approx(-stiffness * overlap));
  state.grains.spin = {spin, -spin};  // they roll on each other
  CHECK(along() == Approx(0.0).margin(1e-12));
}

TEST_CASE("the forces of a moment are those that the step has given") {
  // Elastic forces depend on the places alone, which are those of the last step: K = F dt^2 / m.
  const State state = busy_tube(76, frictionless(0.0));
  const auto forces = present_forces(state, frictionless(0.0));
  int compared = 0;
  for (std::size_t i = 0; i < forces.size(); ++i) {
    const std::int32_t grain = state.contacts[i].name.grain;
    const auto touches_it = [&](const Contact& c) {
      return c.name.grain == grain || (c.name.wall == no_wall && c.name.partner == grain);
    };
    if (std::ranges::count_if(state.contacts, touches_it) > 1) continue;  // a kick of several
    std::size_t slot = 0;
    while (state.grains.id[slot] != grain) ++slot;
    const double to_force = state.grains.mass[slot] / (state.time_step * state.time_step);
    const double kick_x = state.box.metres_x(state.grains.kick[slot].x);
    const double kick_y = state.box.metres_y(state.grains.kick[slot].y);
    CHECK(forces[i].fx == Approx(kick_x * to_force).epsilon(1e-9));
    CHECK(forces[i].fy == Approx(kick_y * to_force).epsilon(1e-9));
    ++compared;
  }
  CHECK(compared > 1);
}
