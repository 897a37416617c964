#include "app/steadiness.hpp"

#include "engine/stopping_rule.hpp"

#include <cstddef>
#include <vector>

namespace riesel::app {

Judged judged_by(const State& state, double interval) {
  constexpr auto velocity = io::JudgedBy::mean_vy, temperature = io::JudgedBy::granular_temperature;
  if (state.gravity.y == 0.0)
    return {.series = temperature, .other = velocity, .free_fall_gain = {}};
  return {.series = velocity, .other = temperature, .free_fall_gain = state.gravity.y * interval};
}

/// Calls `by` with the series of the flow.
template <class By>
auto Steadiness::judge(By by) const {
  const std::vector<double> judged = record_->series(name(by_.series)),
                            other = record_->series(name(by_.other));
  return by(FlowSeries{judged, by_.free_fall_gain, other});
}

SteadyState Steadiness::state() const { return judge(assess_flow); }

bool Steadiness::is_looked_at() const {
  return relative_error_ && is_time_to_look(static_cast<std::size_t>(record_->rows()));
}

bool Steadiness::is_precise_enough() const {
  return is_looked_at()
         && judge([&](const FlowSeries& flow) { return is_precise(flow, *relative_error_); });
}

}  // namespace riesel::app
