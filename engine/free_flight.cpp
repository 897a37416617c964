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

/// An answer that grants all grains the tolerance is used if it gives at least this many steps.
constexpr double few_steps = 4.0;

/// The first s >= 0 with |(x, y) + s (ux, uy)| <= reach; `never` if there is none.
[[gnu::always_inline]] inline double first_touch(double x, double y, double ux, double uy,
                                                 double reach) {
  const double apart = x * x + y * y - reach * reach;
  const double closing = -(x * ux + y * uy);
  const double root2 = closing * closing - (ux * ux + uy * uy) * apart;
  const double steps = apart / (closing + std::sqrt(root2));  // NaN if they never meet
  const double meeting = root2 > 0.0 ? steps : never;
  const double later = closing > 0.0 ? meeting : never;
  return apart > 0.0 ? later : 0.0;
}

/// Arrays by slot.
struct Paths {
  const FixedVector *position, *u;
  const double* radius;
};

Paths paths_of(const Grains& g) {
  return {.position = g.position.data(), .u = g.u.data(), .radius = g.radius.data()};
}

struct MetresPerQuantum {
  double x, y;  // per quantum
};

struct ForesightLoop {
  template <class Numbers>
  [[gnu::always_inline]] static void run(std::size_t count, MetresPerQuantum metres,
                                         double tolerance, Forecast* forecast) {
    Forecast& f = *forecast;
#pragma omp simd
    for (std::size_t k = 0; k < count; ++k) {
      const double x = Numbers::real(f.x[k]) * metres.x, y = Numbers::real(f.y[k]) * metres.y;
      const double ux = Numbers::real(f.ux[k]) * metres.x, uy = Numbers::real(f.uy[k]) * metres.y;
      const double granted = Numbers::real(f.deflected[k]) * tolerance;
      const double patient = first_touch(x, y, ux, uy, f.reach[k] + most_deflected * tolerance);
      const double closer = first_touch(x, y, ux, uy, f.reach[k] + granted);
      f.free_steps[k] =
          Forecast::whole_steps<Numbers>((patient >= few_steps ? patient : closer) * cautious);
      const std::int64_t exact_if_close = is_exact(f.deflected[k]) ? 1 : 0;
      f.exact[k] = patient >= few_steps ? 0 : exact_if_close;
    }
  }
};

struct Horizon {
  double metre_x, metre_y;
  double steps;
  double tolerance;
};

struct SieveLoop {
  /// Sets flags[k] if pair k of these may touch.
  template <class Numbers>
  [[gnu::always_inline]] static void run(const std::uint32_t* first, const std::uint32_t* second,
                                         std::size_t count, Paths c, Horizon h,
                                         std::int64_t* flags) {
#pragma omp simd
    for (std::size_t k = 0; k < count; ++k) {
      const std::int64_t i = first[k], j = second[k];
      const FixedVector apart_by = wrapped_difference(c.position[j], c.position[i]);
      const FixedVector u = wrapped_difference(c.u[j], c.u[i]);
      const double x = Numbers::real(apart_by.x) * h.metre_x;
      const double y = Numbers::real(apart_by.y) * h.metre_y;
      const double ux = Numbers::real(u.x) * h.metre_x, uy = Numbers::real(u.y) * h.metre_y;
      const double reach = (c.radius[i] + c.radius[j]) * generous + most_deflected * h.tolerance;
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
};

/// Fills the input columns of `to` with the relative motion of the pairs on their courses in
/// `step`.
void gather(const Slice& slice, std::span<const std::uint32_t> which, const State& state,
            const Courses& courses, std::int64_t step, Forecast& to) {
  const Paths c = paths_of(state.grains);
  const std::int64_t steps = step - courses.origin();
  for (std::size_t k = 0; k < which.size(); ++k) {
    const std::uint32_t i = slice.pairs.first[which[k]], j = slice.pairs.second[which[k]];
    const FixedVector u = wrapped_difference(c.u[j], c.u[i]);
    const FixedVector apart =
        wrapped_sum(wrapped_difference(c.position[j], c.position[i]), wrapped_product(steps, u));
    to.x[k] = apart.x;
    to.y[k] = apart.y;
    to.ux[k] = u.x;
    to.uy[k] = u.y;
    to.reach[k] = (c.radius[i] + c.radius[j]) * generous;
    to.deflected[k] = deflected_of_pair(slice, courses, which[k]);
  }
}

}  // namespace

void sift(const Slice& slice, PairRange range, const State& state, std::int64_t steps,
          double tolerance, Selection& may_touch) {
  constexpr std::size_t at_a_time = 256;
  alignas(cache_line) std::array<std::int64_t, at_a_time> flags;
  const Horizon horizon{.metre_x = state.box.quantum_x(),
                        .metre_y = state.box.quantum_y(),
                        .steps = static_cast<double>(steps + 1) * generous,
                        .tolerance = tolerance};
  for (std::size_t begin = range.begin; begin < range.end; begin += at_a_time) {
    const std::size_t count = std::min(at_a_time, range.end - begin);
    run_vector_loop<SieveLoop>(&slice.pairs.first[begin], &slice.pairs.second[begin], count,
                               paths_of(state.grains), horizon, flags.data());
    may_touch.take(list_flagged(flags.data(), count, begin, may_touch.room_for(count)));
  }
}

void foresee(const Slice& slice, std::span<const std::uint32_t> which, const State& state,
             const Courses& courses, std::int64_t now, double tolerance, Forecast& result) {
  gather(slice, which, state, courses, now, result);
  const MetresPerQuantum metres{state.box.quantum_x(), state.box.quantum_y()};
  constexpr std::size_t few = 4;  // so soon, a vector load would wait for the scalar stores
  if (which.size() <= few)
    ForesightLoop::run<ByConversion>(which.size(), metres, tolerance, &result);
  else
    run_vector_loop<ForesightLoop>((which.size() + lanes - 1) / lanes * lanes, metres, tolerance,
                                   &result);
}

}  // namespace riesel
