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

Paths paths_of(const Grains& g) {
  return {.x = g.x.data(),
          .y = g.y.data(),
          .ux = g.ux.data(),
          .uy = g.uy.data(),
          .radius = g.radius.data()};
}

/// Some pairs: slots, steps since the courses were set, how far the two may be from them together
/// (m), and whether they may go farther when one more is deflected.
struct Lanes {
  using Integers = std::array<std::int64_t, lanes>;

  alignas(cache_line) Integers first, second, steps_first, steps_second, exact;
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
    const double patient = first_touch(x, y, ux, uy, reach + most_strays * k.tolerance);
    const double closer = first_touch(x, y, ux, uy, reach + pairs.stray[lane]);
    free_steps[lane] = Forecast::whole_steps((patient >= few_steps ? patient : closer) * cautious);
    const std::int64_t is_exact = pairs.exact[lane];
    exact[lane] = patient >= few_steps ? 0 : is_exact;
  }
}

struct Horizon {
  double metre_x, metre_y;
  double steps;
  double tolerance;
};

/// Sets flags[k] if pair k of these may touch.
RIESEL_VECTOR_KERNEL void sift_lanes(const std::uint32_t* first, const std::uint32_t* second,
                                     std::size_t count, Paths c, Horizon h, std::int64_t* flags) {
#pragma omp simd
  for (std::size_t k = 0; k < count; ++k) {
    const std::int64_t i = first[k], j = second[k];
    const double x = real(wrapped_difference(c.x[j], c.x[i])) * h.metre_x;
    const double y = real(wrapped_difference(c.y[j], c.y[i])) * h.metre_y;
    const double ux = real(wrapped_difference(c.ux[j], c.ux[i])) * h.metre_x;
    const double uy = real(wrapped_difference(c.uy[j], c.uy[i])) * h.metre_y;
    const double reach = (c.radius[i] + c.radius[j]) * generous + most_strays * h.tolerance;
    // The square of the distance after s steps is reach^2 + apart - 2 closing s + speed2 s^2.
    const double apart = x * x + y * y - reach * reach;
    const double closing = -(x * ux + y * uy);
    const double speed2 = ux * ux + uy * uy;
    const double at_horizon = apart - (2.0 * closing - speed2 * h.steps) * h.steps;
    const bool passes = closing > 0.0 && closing * closing > speed2 * apart;
    const bool in_time = closing < speed2 * h.steps || at_horizon < 0.0;
    flags[k] = apart <= 0.0 || (passes && in_time) ? 1 : 0;
  }
}

}  // namespace

void sift(const Slice& slice, PairRange range, const State& state, std::int64_t steps,
          double tolerance, std::vector<std::uint32_t>& may_touch) {
  constexpr std::size_t at_a_time = 256;
  alignas(cache_line) std::array<std::int64_t, at_a_time> flags;
  const Horizon horizon{.metre_x = state.box.quantum_x(),
                        .metre_y = state.box.quantum_y(),
                        .steps = static_cast<double>(steps + 1) * generous,
                        .tolerance = tolerance};
  may_touch.resize(range.end - range.begin);
  std::size_t found = 0;
  for (std::size_t begin = range.begin; begin < range.end; begin += at_a_time) {
    const std::size_t count = std::min(at_a_time, range.end - begin);
    sift_lanes(&slice.pairs.first[begin], &slice.pairs.second[begin], count, paths_of(state.grains),
               horizon, flags.data());
    for (std::size_t k = 0; k < count; ++k) {
      may_touch[found] = static_cast<std::uint32_t>(begin + k);
      found += static_cast<std::size_t>(flags[k]);
    }
  }
  may_touch.resize(found);
}

void foresee(const Slice& slice, std::span<const std::uint32_t> which, const State& state,
             const Courses& courses, std::int64_t now, double tolerance, Forecast& result) {
  const std::size_t room = (which.size() + lanes - 1) / lanes * lanes;
  if (result.free_steps.size() < room) {
    result.free_steps.resize(2 * room);
    result.exact.resize(2 * room);
  }
  const Paths paths = paths_of(state.grains);
  const Kinematics kinematics{.metre_x = state.box.quantum_x(),
                              .metre_y = state.box.quantum_y(),
                              .fall = courses.fall(),
                              .now = now,
                              .tolerance = tolerance};
  const std::int64_t since_sorted = now - courses.sorted_at();
  Lanes pairs{};
  for (std::size_t block = 0; block < which.size(); block += lanes) {
    for (std::size_t lane = 0; lane < std::min(lanes, which.size() - block); ++lane) {
      const std::uint32_t pair = which[block + lane];
      const std::uint32_t i = slice.pairs.first[pair], j = slice.pairs.second[pair];
      pairs.first[lane] = i;
      pairs.second[lane] = j;
      pairs.steps_first[lane] = since_sorted - courses.since(i);
      pairs.steps_second[lane] = since_sorted - courses.since(j);
      const int strays = strays_of_pair(slice, courses, pair);
      pairs.stray[lane] = strays * tolerance;
      pairs.exact[lane] = is_exact(strays) ? 1 : 0;
    }
    foresee_lanes(pairs, paths, kinematics, &result.free_steps[block], &result.exact[block]);
  }
}

}  // namespace riesel
