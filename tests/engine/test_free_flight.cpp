// Free flight without rounding: what physics says of a falling grain, quantum for quantum.
#include "engine/parabola.hpp"
#include "engine/simulation.hpp"
#include "tests/catch.hpp"
#include "tests/engine/systems.hpp"

#include <cmath>

using namespace systems;

namespace {

constexpr std::int64_t million = 1'000'000;

/// A grain falls alone; in the other order of magnitude of time steps and lengths a bench or a tube
/// may have.
State falling(double length, double dt, double vy) {
  State state = empty_box(10e-3, length);
  state.gravity.y = 10.0;
  state.time_step = dt;
  add_grain(state, grain(5e-3, 0.0, 0.0, vy));
  return state;
}

}  // namespace

TEST_CASE("a falling grain is where G n^2 / 2 says, to the quantum, after a million steps") {
  const State start = falling(0.1, 1e-6, 0.0);
  const State end = advanced(start, paper_model(), million);
  const Fixed g = fall_per_step(start).y;
  // Half of an odd G is cut off in the first velocity: one half quantum per step.
  const Fixed exact = wrapped_sum(wrapped_product(million, start.grains.u[0].y),
                                  wrapped_product(g, million * (million + 1) / 2));
  CHECK(end.grains.position[0].y == exact);
  CHECK(end.grains.u[0].y == start.grains.u[0].y);
}

TEST_CASE("a falling grain follows g t^2 / 2 to the quantum of gravity") {
  // G = g dt^2 is a whole number of quanta, so g itself is rounded by half a quantum per step^2.
  const double length = GENERATE(0.01, 0.1, 1.0);
  const State start = falling(length, 1e-6, 2.0);
  const State end = advanced(start, paper_model(), million);
  const double t = 1.0, g = start.gravity.y;
  const double rounding_of_g = 0.5 / static_cast<double>(fall_per_step(start).y);
  CHECK(rounding_of_g < 3e-9);
  const double fallen = std::remainder(grain_at(end, 0).y - (2.0 * t + 0.5 * g * t * t), length);
  CHECK(std::abs(fallen) < 0.5 * g * t * t * rounding_of_g + 1e-12);
  CHECK(std::abs(grain_at(end, 0).vy - (2.0 + g * t)) < g * t * rounding_of_g + 1e-12);
}

TEST_CASE("under gravity at an angle a thrown grain flies its parabola") {
  State state = falling(0.1, 1e-6, 2.0);
  state.gravity = {.x = -6.0, .y = 8.0};
  state.grains = {};
  add_grain(state, grain(5e-3, 0.0, 0.3, 2.0));
  const State end = advanced(state, paper_model(), 100'000);
  const double t = 0.1;
  // Gravity is rounded to half a quantum per step^2, which along x are coarser.
  const double rounding_of_g = 0.5 / static_cast<double>(std::abs(fall_per_step(state).x));
  CHECK(rounding_of_g < 3e-9);
  const Grain there = grain_at(end, 0);
  CHECK(there.x == Approx(5e-3 + 0.3 * t - 3.0 * t * t).epsilon(1e-8));
  CHECK(there.vx == Approx(0.3 - 6.0 * t).epsilon(1e-8));
  CHECK(std::abs(std::remainder(there.y - (2.0 * t + 4.0 * t * t), 0.1)) < 1e-9);
  CHECK(there.vy == Approx(2.0 + 8.0 * t).epsilon(1e-8));
}

TEST_CASE("a fast grain crosses the seam many times") {
  State state = empty_box(10e-3, 5e-3);
  add_grain(state, grain(5e-3, 1e-3, 0.0, 50.0));
  const State end = advanced(state, paper_model(), 100'000);  // 5 m: a thousand periods
  CHECK(end.grains.position[0].y
        == wrapped_sum(state.grains.position[0].y, wrapped_product(100'000, state.grains.u[0].y)));
  // The velocity was rounded to a quantum per step: 1e5 half quanta.
  CHECK(std::abs(std::remainder(grain_at(end, 0).y - (1e-3 + 5.0), 5e-3)) < 1e-15);
  CHECK(grain_at(end, 0).vy == Approx(50.0).epsilon(1e-14));
}

TEST_CASE("a grain crosses the seam upwards too") {
  State state = empty_box(10e-3, 5e-3);
  add_grain(state, grain(5e-3, 1e-3, 0.0, -50.0));
  const State end = advanced(state, paper_model(), 100);  // -5 mm: one period
  CHECK(std::abs(grain_at(end, 0).y - 1e-3) < 1e-15);
  CHECK(grain_at(end, 0).y >= 0.0);
}

TEST_CASE("the common fall goes on when velocities exceed a period per step") {
  // U in the falling frame wraps; differences of velocities do not mind.
  State state = empty_box(10e-3, 5e-3);
  state.gravity.y = 10.0;
  state.time_step = 1e-6;
  for (const double y : {1e-3, 3e-3}) add_grain(state, grain(5e-3, y, 0.0, 100.0));
  const State end = advanced(state, paper_model(), 50'000);
  const double apart = grain_of_id(end, 1).y - grain_of_id(end, 0).y;
  CHECK(std::abs(std::remainder(apart - 2e-3, 5e-3)) < 1e-17);
  CHECK(end.tally.grains.begun == 0);
}

TEST_CASE("what is put in comes out") {
  State state = empty_box(10e-3, 30e-3);
  state.gravity.y = 10.0;
  const Grain in{.x = 3.3e-3, .y = -1e-3, .vx = -1.7, .vy = 23.0, .radius = 0.4e-3, .mass = 2e-6};
  add_grain(state, in);
  const Grain out = grain_at(state, 0);
  CHECK(out.x == Approx(in.x).epsilon(1e-15));
  CHECK(out.y == Approx(30e-3 + in.y).epsilon(1e-15));
  CHECK(out.vx == Approx(in.vx).epsilon(1e-13));
  CHECK(out.vy == Approx(in.vy).epsilon(1e-13));
  CHECK(out.radius == in.radius);
  CHECK(out.mass == in.mass);
}

TEST_CASE("y is the same place in every period") {
  const Box box{.width = 1.0, .length = 0.7};
  for (const double y : {0.0, 0.1, 0.35, 0.69})
    for (const double periods : {-3.0, -1.0, 1.0, 2.0}) {
      const Fixed difference =
          wrapped_difference(box.fixed_y(y + periods * box.length), box.fixed_y(y));
      CHECK(std::abs(box.metres_y(difference)) < 1e-15);
    }
  CHECK(box.place_y(box.fixed_y(-0.1)) == Approx(0.6));
  CHECK(box.metres_y(box.fixed_y(0.6)) == Approx(-0.1));
  CHECK(box.fixed_y(0.5 * box.length) == INT64_MIN);
}

TEST_CASE("a place is below the end of the period, however close") {
  const Box box{.width = 1.0, .length = 0.7};
  for (const Fixed below : {1, 100, 500, 2000}) CHECK(box.place_y(-below) < box.length);
  for (const double below : {1e-30, 1e-18, 1e-17, 1e-15}) {
    CHECK(box.wrapped(-below) < box.length);
    CHECK(box.wrapped(box.length - below) < box.length);
  }
}

TEST_CASE("the time until a body comes back is exact, however close by it turns") {
  const double u = -4e-9, a = 9.8e-12;  // m per step: a grain that leaves a floor
  for (const double gap : {1e-9, 1e-13, 1e-17, 1e-20}) {
    // The roots of a s^2 / 2 + u s = gap add up to -2 u / a; the other one is just before now.
    const double other = -2.0 * gap / (std::sqrt(u * u + 2.0 * a * gap) - u);
    const double exact = -2.0 * u / a - other;
    CHECK(steps_to_go(gap, u, a) == Approx(exact).epsilon(1e-14));
  }
  CHECK(std::isinf(steps_to_go(1e-3, -1.0, 0.0)));
  CHECK(steps_to_go(1e-3, 1e-6, 0.0) == Approx(1000.0));
}
