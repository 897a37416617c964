#include "engine/free_flight.hpp"

#include "engine/vector_kernel.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace riesel {

namespace {

constexpr std::size_t lanes = 8;
constexpr double never = 1e18;  // steps

constexpr double cautious = 1.0 / generous;

/// Fewer steps than this are not worth a generous answer.
constexpr double few_steps = 4.0;

/// The first s with |(x, y) + s (ux, uy)| = reach: 0 if they are closer already.
[[gnu::always_inline]] inline double first_touch(double x, double y, double ux, double uy,
                                                 double reach) {
  const double apart = x * x + y * y - reach * reach;
  const double closing = -(x * ux + y * uy);
  const double root2 = closing * closing - (ux * ux + uy * uy) * apart;
  const double steps = apart / (closing + std::sqrt(root2));  // not a number if never
  const double meeting = root2 > 0.0 ? steps : never;
  const double later = closing > 0.0 ? meeting : never;
  return apart > 0.0 ? later : 0.0;
}

/// Arrays by slot.
struct Paths {
  const Fixed *x, *y, *ux, *uy;
  const double* radius;
};

/// Some pairs: slots, steps since the courses were set, and how far the two may be from them
/// together (m).
struct Lanes {
  using Integers = std::array<std::int64_t, lanes>;

  alignas(cache_line) Integers first, second, steps_first, steps_second;
  std::array<double, lanes> stray;
};

struct Kinematics {
  double metre_x, metre_y;
  Fall fall;
  std::int64_t now;
  double tolerance;
};

RIESEL_VECTOR_KERNEL void foresee_lanes(const Lanes& pairs, Paths c, Kinematics k,
                                        std::int64_t* free_steps, std::int64_t* exact) {
#pragma omp simd
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const std::int64_t i = pairs.first[lane], j = pairs.second[lane];
    const std::int64_t steps_i = pairs.steps_first[lane], steps_j = pairs.steps_second[lane];
    const Fixed falls = wrapped_difference(sum_of_steps(k.now - steps_j, k.now),
                                           sum_of_steps(k.now - steps_i, k.now));
    const Fixed x_i = wrapped_sum(c.x[i], wrapped_product(steps_i, c.ux[i]));
    const Fixed x_j = wrapped_sum(c.x[j], wrapped_product(steps_j, c.ux[j]));
    const Fixed y_i = wrapped_sum(c.y[i], wrapped_product(steps_i, c.uy[i]));
    const Fixed y_j = wrapped_sum(c.y[j], wrapped_product(steps_j, c.uy[j]));
    const Fixed x_ij = wrapped_sum(wrapped_difference(x_j, x_i), wrapped_product(falls, k.fall.x));
    const Fixed y_ij = wrapped_sum(wrapped_difference(y_j, y_i), wrapped_product(falls, k.fall.y));

    const double x = real(x_ij) * k.metre_x;
    const double y = real(y_ij) * k.metre_y;
    const double ux = real(wrapped_difference(c.ux[j], c.ux[i])) * k.metre_x;
    const double uy = real(wrapped_difference(c.uy[j], c.uy[i])) * k.metre_y;
    const double reach = (c.radius[i] + c.radius[j]) * generous;
    const double stray = pairs.stray[lane];
    const double patient = first_touch(x, y, ux, uy, reach + 2.0 * k.tolerance);
    const double closer = first_touch(x, y, ux, uy, reach + stray);
    free_steps[lane] = Forecast::whole_steps((patient >= few_steps ? patient : closer) * cautious);
    const std::int64_t is_exact = stray >= 2.0 * k.tolerance ? 0 : 1;
    exact[lane] = patient >= few_steps ? 0 : is_exact;
  }
}

}  // namespace

void foresee(const Slice& slice, std::span<const std::uint32_t> which, const State& state,
             const Courses& courses, std::int64_t now, double tolerance, Forecast& result) {
  const std::size_t room = (which.size() + lanes - 1) / lanes * lanes;
  if (result.free_steps.size() < room) {
    result.free_steps.resize(2 * room);
    result.exact.resize(2 * room);
  }
  const Grains& g = state.grains;
  const Paths paths{.x = g.x.data(),
                    .y = g.y.data(),
                    .ux = g.ux.data(),
                    .uy = g.uy.data(),
                    .radius = g.radius.data()};
  const Kinematics kinematics{.metre_x = state.box.quantum_x(),
                              .metre_y = state.box.quantum_y(),
                              .fall = courses.fall(),
                              .now = now,
                              .tolerance = tolerance};
  const std::array strays{0.0, tolerance, 2.0 * tolerance};
  const std::int64_t since_sorted = now - courses.sorted_at();
  const std::size_t begin = slice.begin, own = slice.end - slice.begin;
  Lanes pairs{};
  for (std::size_t block = 0; block < which.size(); block += lanes) {
    for (std::size_t lane = 0; lane < std::min(lanes, which.size() - block); ++lane) {
      const std::uint32_t pair = which[block + lane];
      const std::uint32_t i = slice.pairs.first[pair], j = slice.pairs.second[pair];
      pairs.first[lane] = i;
      pairs.second[lane] = j;
      pairs.steps_first[lane] = since_sorted - courses.since(i);
      pairs.steps_second[lane] = since_sorted - courses.since(j);
      // Whether a foreign grain is deflected is for its own slice to know.
      const bool second_may_stray = j - begin >= own || courses.deflected(j);
      pairs.stray[lane] = strays[(courses.deflected(i) ? 1U : 0U) + (second_may_stray ? 1U : 0U)];
    }
    foresee_lanes(pairs, paths, kinematics, &result.free_steps[block], &result.exact[block]);
  }
}

}  // namespace riesel
