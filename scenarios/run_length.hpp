// How long a flow is followed: for a given time, or until its mean is known precisely enough.
#pragma once

#include "io/settings.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace riesel::scenarios {

inline constexpr double most_steps = 1e15;  ///< of any run; far from overflow of a counter

/// A run is checked at least once in so many steps: for limits, walls and the range of its numbers.
inline constexpr std::int64_t steps_per_look = 10'000;

struct RunLength {
  double at_most;                        ///< s, simulated
  std::optional<double> relative_error;  ///< of the judged mean: the run ends once it is reached
  std::string key;                       ///< the setting that `at_most` comes from
};

/// The settings `run.duration` and `run.until`.
io::SettingsTable run_length_settings();

/// Throws io::SettingsError unless there is either a duration, or both a precision and a limit.
RunLength run_length(const io::Settings& settings);

/// Throws io::SettingsError if the run would take more than `most_steps` steps of `time_step` (s).
void reject_too_many_steps(const io::Settings& settings, const RunLength& length, double time_step);

/// The number of steps of `time_step` (s) closest to `seconds`, but at least one: between two rows
/// or frames.
std::int64_t steps_between(double seconds, double time_step);

}  // namespace riesel::scenarios
