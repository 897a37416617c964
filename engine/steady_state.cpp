#include "engine/steady_state.hpp"

#include "engine/named.hpp"
#include "engine/time_series.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace riesel {
namespace {

constexpr std::array<Word<SteadyVerdict>, 4> verdicts = {
    {{SteadyVerdict::steady, "steady"},
     {SteadyVerdict::accelerating, "accelerating"},
     {SteadyVerdict::drifting, "drifting"},
     {SteadyVerdict::too_short, "too_short"}}};

bool is_runaway(const TrendEstimate& trend, double mean, double trend_duration,
                std::optional<double> free_fall_gain) {
  const bool gains = trend.slope * trend_duration >= runaway_fraction * std::abs(mean);
  const bool falls = free_fall_gain && trend.slope >= runaway_fraction * *free_fall_gain;
  return trend.slope > 0.0 && (gains || falls);
}

/// Whether the flow begins to fall at the end, after it had been held for most of the run. A trend
/// over the whole run does not show that, as the series has a bend.
bool breaks_away(std::span<const double> velocities, std::optional<double> free_fall_gain) {
  if (!free_fall_gain) return false;
  const TrendEstimate end = estimate_trend(velocities.last(velocities.size() / 5));
  return is_significant(end) && end.slope >= breakaway_fraction * *free_fall_gain;
}

// The trend is tested first: a fall looks like one long correlation, and would be called too short.
SteadyVerdict verdict_on(const MeanEstimate& mean, const TrendEstimate& trend,
                         double trend_duration, bool has_arrived,
                         std::optional<double> free_fall_gain) {
  if (is_significant(trend)) {
    return is_runaway(trend, mean.mean, trend_duration, free_fall_gain)
               ? SteadyVerdict::accelerating
               : SteadyVerdict::drifting;
  }
  if (!has_arrived || mean.independent_samples < min_independent_samples) {
    return SteadyVerdict::too_short;
  }
  return SteadyVerdict::steady;
}

}  // namespace

// MSER balances the bias of what it keeps against the noise, so that at its cut the bias is about
// as large as the error bar. Cutting twice as much squares the remaining factor of an exponential
// approach. If there is no room for that, the run has not arrived at a steady state. A trend needs
// length more than freedom from bias, and is estimated from at least half of the run.
SteadyState assess_steady_state(std::span<const double> velocities,
                                std::optional<double> free_fall_gain) {
  const std::size_t cut = transient_length(velocities);
  const bool has_arrived = 5 * cut <= 2 * velocities.size();
  const std::size_t transient_end = has_arrived ? 2 * cut : cut;
  const std::size_t trend_start = std::min(transient_end, velocities.size() / 2);

  MeanEstimate mean = estimate_mean(velocities.subspan(transient_end));
  // Zero throughout is no measurement: whatever moves, this series does not show it.
  if (mean.mean == 0.0 && mean.error == 0.0) mean.independent_samples = 0.0;
  const TrendEstimate trend = estimate_trend(velocities.subspan(trend_start));
  const auto trend_duration = static_cast<double>(velocities.size() - trend_start);
  return {.verdict = breaks_away(velocities, free_fall_gain)
                         ? SteadyVerdict::accelerating
                         : verdict_on(mean, trend, trend_duration, has_arrived, free_fall_gain),
          .transient_end = transient_end,
          .mean = mean.mean,
          .error = mean.error,
          .autocorrelation_time = mean.autocorrelation_time,
          .independent_samples = mean.independent_samples,
          .trend = trend.slope,
          .trend_error = trend.error};
}

FlowSeries FlowSeries::first(std::size_t samples) const {
  FlowSeries begin{judged.first(samples), free_fall_gain, {}};
  for (const std::span<const double> other : others) begin.others.push_back(other.first(samples));
  return begin;
}

SteadyState assess_flow(const FlowSeries& flow) {
  SteadyState state = assess_steady_state(flow.judged, flow.free_fall_gain);
  if (state.verdict != SteadyVerdict::steady) return state;
  for (std::size_t i = 0; i < flow.others.size(); ++i) {
    const SteadyState other = assess_steady_state(flow.others[i]);
    const bool is_constant = other.error == 0.0 && other.trend == 0.0;
    if (is_constant || other.verdict == SteadyVerdict::steady) continue;
    const bool drifts = other.verdict != SteadyVerdict::too_short;
    const auto verdict = drifts ? SteadyVerdict::drifting : SteadyVerdict::too_short;
    const bool is_told_already =
        state.verdict == SteadyVerdict::drifting || state.verdict == verdict;
    if (is_told_already) continue;
    state.verdict = verdict;
    state.independent_samples = other.independent_samples;
    state.held_back_by = i;
  }
  return state;
}

std::string_view name(SteadyVerdict verdict) { return name_in(verdicts, verdict); }

std::optional<SteadyVerdict> steady_verdict_named(std::string_view text) {
  return value_in(verdicts, text);
}

}  // namespace riesel
