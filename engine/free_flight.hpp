// When two grains that keep to their courses, or nearly so, can touch: computed for many pairs at
// once by vector instructions.
#pragma once

#include "engine/aligned.hpp"
#include "engine/courses.hpp"
#include "engine/fixed_point.hpp"
#include "engine/selection.hpp"
#include "engine/slice.hpp"
#include "engine/state.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace riesel {

/// Factor by which bounds are rounded to the safe side; far above the rounding errors.
inline constexpr double generous = 1.0 + 1e-9;

/// For each of up to most_pairs pairs, the number of steps until it may touch. A column has an
/// element for each pair.
struct Forecast {
  /// Pairs that are foreseen together: enough for vectors to be full, few enough to stay in the
  /// cache.
  static constexpr std::size_t most_pairs = 256;
  template <class T>
  using Column = std::array<T, most_pairs>;

  /// Stands for any larger number of steps.
  static constexpr std::int64_t forever = std::int64_t{1} << 30;

  /// The pair cannot touch before this many steps from now.
  alignas(cache_line) Column<std::int64_t> free_steps;
  Column<std::int64_t> exact;  ///< 1 if that holds only until another grain of it is deflected

  /// Input: the motion of the second grain of each pair relative to the first; gathered by a scalar
  /// loop, as vector gathers are not faster.
  Column<Fixed> x, y, ux, uy;      ///< quanta, and per step
  Column<double> reach;            ///< m, generous
  Column<std::int64_t> deflected;  ///< deflected_of_pair()

  /// `steps` rounded up to a whole number, or at most one less; at most `forever`, also for NaN.
  template <class Numbers = ByConversion>
  [[gnu::always_inline]] static std::int64_t whole_steps(double steps) {
    constexpr auto most = static_cast<double>(forever);
    constexpr double nearly_half = 0.499;  // never beyond the next whole number
    return Numbers::whole(steps < most ? steps + nearly_half : most);
  }
};

/// The most grains of a pair that may be off their courses.
inline constexpr int most_deflected = 2;

/// How many grains of a pair may be off their courses. Counts a second grain of another slice in
/// any case, as whether it is deflected is not known here.
inline int deflected_of_pair(const Slice& slice, const Courses& courses, std::uint32_t pair) {
  const std::uint32_t i = slice.pairs.first[pair], j = slice.pairs.second[pair];
  return (courses.deflected(i) ? 1 : 0) + (!slice.owns(j) || courses.deflected(j) ? 1 : 0);
}

/// Whether what is foreseen for a pair of which `deflected` grains may be off their courses holds
/// only until the other one is deflected.
inline bool is_exact(std::int64_t deflected) { return deflected < most_deflected; }

/// Computes result.free_steps[k] and result.exact[k] for slice.pairs[which[k]], from step `now` on,
/// for at most Forecast::most_pairs pairs. A deflected grain may be off its course by `tolerance`
/// (m). If the pair is free for some steps even when both grains are granted that, deflected or
/// not, they are, so that the answer stays right when a contact begins.
void foresee(const Slice& slice, std::span<const std::uint32_t> which, const State& state,
             const Courses& courses, std::int64_t now, double tolerance, Forecast& result);

/// The candidate pairs with these indices, begin <= index < end.
struct PairRange {
  std::size_t begin, end;
};

/// Adds to `may_touch` the indices of those pairs of `range` that may touch within `steps`; none is
/// missed as long as no grain is farther than `tolerance` (m) from its course. The present step
/// must be the origin of the courses. Most pairs stay apart until they are listed again, and
/// finding that out is cheaper than finding out when they touch.
void sift(const Slice& slice, PairRange range, const State& state, std::int64_t steps,
          double tolerance, Selection& may_touch);

}  // namespace riesel
