#include "scenarios/run_length.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace riesel::scenarios {

namespace {

constexpr auto duration_key = "run.duration";
constexpr auto error_key = "run.until.relative_error";
constexpr auto limit_key = "run.until.at_most";

RunLength until_precise(const io::Settings& settings) {
  if (!settings.has(error_key))
    settings.reject(error_key, "is missing", "give the error bar to stop at, such as '1 %'");
  if (!settings.has(limit_key))
    settings.reject(limit_key, "is missing",
                    "give the longest time to be simulated, such as '20 s'");
  return {.at_most = settings.number(limit_key),
          .relative_error = settings.number(error_key),
          .key = limit_key};
}

}  // namespace

io::SettingsTable run_length_settings() {
  return {
      {.key = duration_key,
       .unit = "s",
       .starter = "1 s",
       .range = io::positive(),
       .doc = "Simulated time. Give this or `run.until`."},
      {.key = error_key,
       .unit = "1",
       .example = "1 %",
       .range = io::above_up_to(0.0, 1.0),
       .doc = "The run ends when the mean axial velocity (where gravity does not pull along the "
              "walls, the granular temperature) is steady with an error bar of at most this part "
              "of it (docs/statistics.md)."},
      {.key = limit_key,
       .unit = "s",
       .example = "20 s",
       .range = io::positive(),
       .doc = "Simulated time after which such a run ends in any case."},
  };
}

RunLength run_length(const io::Settings& settings) {
  const bool until = settings.has(error_key) || settings.has(limit_key);
  if (until && settings.has(duration_key))
    settings.reject(
        duration_key, "cannot be given together with run.until",
        "remove one of the two: on the command line by --set run.duration= or --set run.until=, in "
        "a sweep file by 'run.duration:' without a value, below 'set:'");
  if (until) return until_precise(settings);
  if (!settings.has(duration_key))
    settings.reject(duration_key, "is missing", "give a time such as '2 s', or run.until");
  return {.at_most = settings.number(duration_key), .relative_error = {}, .key = duration_key};
}

void reject_too_many_steps(const io::Settings& settings, const RunLength& length,
                           double time_step) {
  if (length.at_most / time_step > most_steps)
    settings.reject(length.key, "more time steps than can be counted",
                    fmt::format("choose at most {:.3g} s", most_steps * time_step));
}

std::int64_t steps_between(double seconds, double time_step) {
  return std::llround(std::clamp(seconds / time_step, 1.0, most_steps));
}

}  // namespace riesel::scenarios
