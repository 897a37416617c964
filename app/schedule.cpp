#include "app/schedule.hpp"

#include <algorithm>
#include <cmath>

namespace riesel::app {

Schedule::Schedule(const io::Settings& settings, double time_step)
    : steps_per_row(scenarios::steps_between(settings.number("output.interval"), time_step)),
      seconds_between_checkpoints(settings.number("output.checkpoint_interval")) {
  const scenarios::RunLength length = scenarios::run_length(settings);
  last_step = std::max(1LL, std::llround(std::ceil(length.at_most / time_step - 1e-9)));
  relative_error = length.relative_error;
  constexpr auto trajectory_key = "output.trajectory_interval";
  if (settings.has(trajectory_key))
    steps_per_frame = scenarios::steps_between(settings.number(trajectory_key), time_step);
}

std::int64_t Schedule::next(std::int64_t step) const {
  const auto after = [step](std::int64_t steps) { return (step / steps + 1) * steps; };
  const std::int64_t look =
      std::min({after(steps_per_row), after(scenarios::steps_per_look), last_step});
  return steps_per_frame > 0 ? std::min(look, after(steps_per_frame)) : look;
}

}  // namespace riesel::app
