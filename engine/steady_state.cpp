#include "engine/steady_state.hpp"

#include "engine/time_series.hpp"

#include <algorithm>
#include <cmath>

namespace riesel {
namespace {

bool is_runaway(const TrendEstimate& trend, double mean, double duration,
                std::optional<double> free_fall_gain) {
  const bool gains = trend.slope * duration >= runaway_fraction * std::abs(mean);
  const bool falls = free_fall_gain && trend.slope >= runaway_fraction * *free_fall_gain;
  return trend.slope > 0.0 && (gains || falls);
}

// The trend comes first: a fall looks like one long correlation, and would pass for too short.
SteadyVerdict verdict_on(const MeanEstimate& mean, const TrendEstimate& trend, double duration,
                         bool has_arrived, std::optional<double> free_fall_gain) {
  if (is_significant(trend)) {
    return is_runaway(trend, mean.mean, duration, free_fall_gain) ? SteadyVerdict::accelerating
                                                                  : SteadyVerdict::drifting;
  }
  if (!has_arrived || mean.independent_samples < min_independent_samples) {
    return SteadyVerdict::too_short;
  }
  return SteadyVerdict::steady;
}

}  // namespace

// MSER weighs the bias of what it keeps against the noise, so that at its cut the bias is as large
// as the error bar. To cut as much again takes the bias of an exponential approach to its square.
// Where there is no room for that the run has not arrived, and its trend shows best after one cut.
SteadyState assess_steady_state(std::span<const double> velocities,
                                std::optional<double> free_fall_gain) {
  const std::size_t cut = transient_length(velocities);
  const bool has_arrived = 5 * cut <= 2 * velocities.size();
  const std::size_t transient_end = has_arrived ? 2 * cut : cut;
  const std::span<const double> settled = velocities.subspan(transient_end);

  const MeanEstimate mean = estimate_mean(settled);
  const TrendEstimate trend = estimate_trend(settled);
  const auto duration = static_cast<double>(settled.size());
  return {.verdict = verdict_on(mean, trend, duration, has_arrived, free_fall_gain),
          .transient_end = transient_end,
          .mean = mean.mean,
          .error = mean.error,
          .autocorrelation_time = mean.autocorrelation_time,
          .independent_samples = mean.independent_samples,
          .trend = trend.slope,
          .trend_error = trend.error};
}

std::string_view name(SteadyVerdict verdict) {
  switch (verdict) {
  case SteadyVerdict::steady:
    return "steady";
  case SteadyVerdict::accelerating:
    return "accelerating";
  case SteadyVerdict::drifting:
    return "drifting";
  case SteadyVerdict::too_short:
    return "too_short";
  }
  return "unknown";
}

}  // namespace riesel
