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

/// The candidate pairs of a slice, and where its deflected grains stand.
struct PairsOfSlice {
  const std::uint32_t *first, *second;
  const std::int32_t* place;  // by slot
  std::int64_t begin, end;    // own slots: those of others may be changing their place
};

struct Kinematics {
  double metre_x, metre_y;
  std::int64_t steps;  // from the origin of the courses
  double tolerance;
};

/// The pairs which[0] to which[lanes - 1].
RIESEL_VECTOR_KERNEL void foresee_lanes(const std::uint32_t* which, PairsOfSlice p, Paths c,
                                        Kinematics k, std::int64_t* free_steps,
                                        std::int64_t* exact) {
#pragma omp simd
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const std::int64_t pair = which[lane];
    const std::int64_t i = p.first[pair], j = p.second[pair];
    const Fixed ux_ij = wrapped_difference(c.ux[j], c.ux[i]);
    const Fixed uy_ij = wrapped_difference(c.uy[j], c.uy[i]);
    const Fixed x_ij =
        wrapped_sum(wrapped_difference(c.x[j], c.x[i]), wrapped_product(k.steps, ux_ij));
    const Fixed y_ij =
        wrapped_sum(wrapped_difference(c.y[j], c.y[i]), wrapped_product(k.steps, uy_ij));

    // As strays_of_pair(), without the conditions of which GCC 12 makes no vectors.
    const std::int64_t beyond = (j - p.begin) | (p.end - 1 - j);  // negative: a foreign grain
    const std::int64_t foreign = beyond < 0 ? 1 : 0;
    const std::int64_t off_i = p.place[i] - Courses::flying;
    const std::int64_t off_j = (p.place[beyond < 0 ? p.begin : j] - Courses::flying) | foreign;
    const std::int64_t strays = (off_i != 0 ? 1 : 0) + (off_j != 0 ? 1 : 0);

    const double x = real(x_ij) * k.metre_x;
    const double y = real(y_ij) * k.metre_y;
    const double ux = real(ux_ij) * k.metre_x;
    const double uy = real(uy_ij) * k.metre_y;
    const double reach = (c.radius[i] + c.radius[j]) * generous;
    const double patient = first_touch(x, y, ux, uy, reach + most_strays * k.tolerance);
    const double closer = first_touch(x, y, ux, uy, reach + real(strays) * k.tolerance);
    free_steps[lane] = Forecast::whole_steps((patient >= few_steps ? patient : closer) * cautious);
    const std::int64_t exact_if_close = is_exact(strays) ? 1 : 0;
    exact[lane] = patient >= few_steps ? 0 : exact_if_close;
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
  const PairsOfSlice pairs{.first = slice.pairs.first.data(),
                           .second = slice.pairs.second.data(),
                           .place = courses.places(),
                           .begin = static_cast<std::int64_t>(slice.begin),
                           .end = static_cast<std::int64_t>(slice.end)};
  const Kinematics kinematics{.metre_x = state.box.quantum_x(),
                              .metre_y = state.box.quantum_y(),
                              .steps = now - courses.origin(),
                              .tolerance = tolerance};
  const auto foresee_block = [&](const std::uint32_t* some, std::size_t block) {
    foresee_lanes(some, pairs, paths, kinematics, &result.free_steps[block], &result.exact[block]);
  };
  const std::size_t whole = which.size() / lanes * lanes;
  for (std::size_t block = 0; block < whole; block += lanes) foresee_block(&which[block], block);
  if (whole == which.size()) return;
  std::array<std::uint32_t, lanes> rest;
  rest.fill(which.back());
  std::copy(which.begin() + static_cast<std::ptrdiff_t>(whole), which.end(), rest.begin());
  foresee_block(rest.data(), whole);
}

}  // namespace riesel
