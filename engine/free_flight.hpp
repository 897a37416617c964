// When can two grains touch that keep to their courses, or nearly so? Computed for many pairs at
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

/// Bounds are rounded to the safe side by this factor, which is far above the error of the
/// arithmetic.
inline constexpr double generous = 1.0 + 1e-9;

/// The time of pairs until they may touch. Columns by pair.
struct Forecast {
  /// Pairs that are foreseen together: enough for vectors to be full, not so many that they leave
  /// the cache.
  static constexpr std::size_t most_pairs = 256;
  template <class T>
  using Column = std::array<T, most_pairs>;

  /// A number of steps that never pass.
  static constexpr std::int64_t forever = std::int64_t{1} << 30;

  alignas(cache_line) Column<std::int64_t> free_steps;  ///< no contact before this step from now
  Column<std::int64_t> exact;  ///< 1 if only as long as the grains stray no farther than now

  /// How the second grain of each pair moves, as seen from the first: gathered one by one, as
  /// vectors are not faster at that.
  Column<Fixed> x, y, ux, uy;   ///< quanta, and per step
  Column<double> reach;         ///< m, generous
  Column<std::int64_t> strays;  ///< strays_of_pair()

  /// The first whole step that is not before `steps`, at most one too early; `forever` if beyond.
  template <class Numbers = ByConversion>
  [[gnu::always_inline]] static std::int64_t whole_steps(double steps) {
    constexpr auto most = static_cast<double>(forever);
    constexpr double nearly_half = 0.499;  // up to the next whole step, but never beyond it
    return Numbers::whole(steps < most ? steps + nearly_half : most);
  }
};

/// The most grains of a pair that may be off their courses.
inline constexpr int most_strays = 2;

/// How many grains of a pair may be off their courses. Whether a second grain that is not in the
/// slice is deflected is not known here.
inline int strays_of_pair(const Slice& slice, const Courses& courses, std::uint32_t pair) {
  const std::uint32_t i = slice.pairs.first[pair], j = slice.pairs.second[pair];
  return (courses.deflected(i) ? 1 : 0) + (!slice.owns(j) || courses.deflected(j) ? 1 : 0);
}

/// Whether what is foreseen for a pair with so many strays holds only as long as no other grain of
/// it is deflected.
inline bool is_exact(std::int64_t strays) { return strays < most_strays; }

/// Computes result.free_steps[k] and result.exact[k] for slice.pairs[which[k]], from step `now` on.
/// `which` are Forecast::most_pairs at most.
/// A deflected grain may be off its course by `tolerance` (m). Where there is time enough, all
/// grains are granted as much, deflected or not, so that the answer outlives the beginning of
/// contacts.
void foresee(const Slice& slice, std::span<const std::uint32_t> which, const State& state,
             const Courses& courses, std::int64_t now, double tolerance, Forecast& result);

/// Indices of candidate pairs.
struct PairRange {
  std::size_t begin, end;
};

/// Adds those of the pairs to `may_touch` that may touch within `steps`; none is overlooked as long
/// as no grain is farther than `tolerance` (m) from its course. All courses have just been set.
/// Most pairs that have just been listed stay apart until they are listed again, and to know that
/// takes less than to know when they touch.
void sift(const Slice& slice, PairRange range, const State& state, std::int64_t steps,
          double tolerance, Selection& may_touch);

}  // namespace riesel
