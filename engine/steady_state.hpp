// Whether a run has reached a steady state, and the mean it has there.
//
// On the fast branch of the tube the grains fall for seconds before wall and gravity balance. A
// mean over such a run is meaningless, so that means are returned only together with a verdict.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace riesel {

enum class SteadyVerdict {
  steady,        ///< no trend, and long enough to tell: mean and error can be trusted
  accelerating,  ///< runaway: a significant growth that is large, see runaway_fraction
  drifting,      ///< a significant trend of either sign that is no runaway
  too_short      ///< no trend to be seen, but too few independent samples or too long a transient
};

/// Velocities in the unit of the samples, times in sample intervals. The mean and the numbers that
/// belong to it are of the samples after the transient; the trend is of these or of the second half
/// of the series, whichever is longer.
struct SteadyState {
  SteadyVerdict verdict;
  std::size_t transient_end;    ///< index of the first sample after the transient, if there is any
  double mean;                  ///< a property of the flow only if `verdict` is `steady`
  double error;                 ///< of the mean, 68 %
  double autocorrelation_time;  ///< sample intervals per independent sample
  double independent_samples;   ///< how many the error rests on
  double trend;                 ///< velocity gained per sample interval
  double trend_error;           ///< 68 %
  std::optional<std::size_t> held_back_by = {};  ///< which of FlowSeries::others, see assess_flow()
};

/// A significant growth is a runaway if what it gains in the time over which it is seen is this
/// part of the mean, or if it is this part of free fall.
inline constexpr double runaway_fraction = 0.1;

/// A significant growth in the last fifth of the series that is this part of free fall is a
/// runaway, too, whatever there was before.
inline constexpr double breakaway_fraction = 0.5;

/// Judges a series of velocities (positive downstream), or of another quantity that may be steady,
/// sampled at even intervals. `free_fall_gain` is what a grain in free fall gains per sample
/// interval, g times the interval, in the unit of the samples; none where gravity does not pull
/// along the flow, or where the quantity is no velocity. The transient is twice what MSER-5 cuts; a
/// run of which MSER-5 cuts more than two fifths has not arrived: it cannot be steady, and a single
/// cut is its transient. The rest is judged by the estimates of time_series.hpp. About one in a
/// hundred stationary series is called accelerating or drifting (measured:
/// docs/statistics-methods.md). Throws std::invalid_argument for a sample that is not finite.
SteadyState assess_steady_state(std::span<const double> velocities,
                                std::optional<double> free_fall_gain = std::nullopt);

/// Series of a flow, sampled at the same moments.
struct FlowSeries {
  std::span<const double> judged;               ///< gives the mean
  std::optional<double> free_fall_gain;         ///< of `judged`, see assess_steady_state()
  std::vector<std::span<const double>> others;  ///< have to be steady, too

  FlowSeries first(std::size_t samples) const;
};

/// Judges a flow: its velocity may be steady while it cools, or its temperature while it slows
/// down, or both while grains still begin to spin, and what is slow in any of them is slow in the
/// profiles. So a flow whose judged series is `steady` is `drifting`, or else `too_short`, if
/// another series is no better than that; it is then held back by the first of these, and
/// `independent_samples` is that of this series. A constant series holds nothing back. Throws
/// std::invalid_argument for a sample that is not finite.
SteadyState assess_flow(const FlowSeries& flow);

/// The verdict as it is written to files: "steady", "accelerating", "drifting", "too_short".
std::string_view name(SteadyVerdict verdict);

/// The inverse of name(SteadyVerdict); nothing for any other text.
std::optional<SteadyVerdict> steady_verdict_named(std::string_view text);

}  // namespace riesel
