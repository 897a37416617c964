// How long a flow is followed: for a given time, or until its mean velocity is known well enough.
#pragma once

#include "io/settings.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace riesel::scenarios {

inline constexpr double most_steps = 1e15;  ///< of any run: far below what a counter holds

/// Steps after which it is looked at the latest whether a run is still what it should be.
inline constexpr std::int64_t steps_per_look = 10'000;

struct RunLength {
  double at_most;                        ///< s, simulated
  std::optional<double> relative_error;  ///< of the mean that is judged, to stop at; or none
  std::string key;                       ///< the setting that `at_most` comes from
};

/// The rows of the table: `run.duration` and `run.until`.
io::SettingsTable run_length_settings();

/// Throws SettingsError unless there is a duration, or else both a precision and a limit.
RunLength run_length(const io::Settings& settings);

/// Throws SettingsError if steps of `time_step` (s) would be more than can be counted.
void reject_too_many_steps(const io::Settings& settings, const RunLength& length, double time_step);

/// Steps between two rows or frames that are `seconds` apart: at least one.
std::int64_t steps_between(double seconds, double time_step);

}  // namespace riesel::scenarios
