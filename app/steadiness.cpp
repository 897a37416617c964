#include "app/steadiness.hpp"

#include "engine/stopping_rule.hpp"

#include <cstddef>
#include <vector>

namespace riesel::app {

Judged judged_by(const State& state, double interval) {
  using enum io::JudgedBy;
  Judged by =
      state.gravity.y == 0.0
          ? Judged{.series = granular_temperature, .others = {mean_vy}, .free_fall_gain = {}}
          : Judged{.series = mean_vy,
                   .others = {granular_temperature},
                   .free_fall_gain = state.gravity.y * interval};
  if (state.grains.rotate()) by.others.push_back(rotational_temperature);
  return by;
}

/// Calls `by` with the series of the flow.
template <class By>
auto Steadiness::judge(By by) const {
  const std::vector<double> judged = record_->series(name(by_.series));
  std::vector<std::vector<double>> others;
  for (const io::JudgedBy other : by_.others) others.push_back(record_->series(name(other)));
  return by(FlowSeries{judged, by_.free_fall_gain, {others.begin(), others.end()}});
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
