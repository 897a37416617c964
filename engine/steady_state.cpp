#include "engine/steady_state.hpp"

#include "engine/time_series.hpp"

#include <cmath>

namespace riesel {
namespace {

bool is_runaway(const TrendEstimate& trend, double mean, double duration,
                std::optional<double> free_fall_gain) {
  const bool doubles_soon = trend.slope * duration >= runaway_fraction * std::abs(mean);
  const bool falls = free_fall_gain && trend.slope >= runaway_fraction * *free_fall_gain;
  return trend.slope > 0.0 && (doubles_soon || falls);
}

// The trend comes first: a fall looks like one long correlation, and would pass for too short.
SteadyVerdict verdict_on(const MeanEstimate& mean, const TrendEstimate& trend, double duration,
                         std::optional<double> free_fall_gain) {
  if (is_significant(trend)) {
    return is_runaway(trend, mean.mean, duration, free_fall_gain) ? SteadyVerdict::accelerating
                                                                  : SteadyVerdict::drifting;
  }
  if (mean.independent_samples < min_independent_samples) return SteadyVerdict::too_short;
  return SteadyVerdict::steady;
}

}  // namespace

SteadyState assess_steady_state(std::span<const double> velocities,
                                std::optional<double> free_fall_gain) {
  const std::size_t transient = transient_length(velocities);
  const std::span<const double> settled = velocities.subspan(transient);
  const MeanEstimate mean = estimate_mean(settled);
  const TrendEstimate trend = estimate_trend(settled);
  const auto duration = static_cast<double>(settled.size());
  return {.verdict = verdict_on(mean, trend, duration, free_fall_gain),
          .transient_end = transient,
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
  return "too_short";
}

}  // namespace riesel
