// Limits beyond which a flow is stopped, or its user warned.
#pragma once

#include "io/settings.hpp"

#include <optional>

namespace riesel::scenarios {

/// A limit that is not set is not watched.
struct RunLimits {
  std::optional<double> overlap;            ///< see LargestOverlap::ratio
  std::optional<double> energy_error;       ///< see energy_error_ratio()
  std::optional<double> speed;              ///< m/s, of any grain
  std::optional<double> steps_per_contact;  ///< a lower limit, for the 5 % quantile of durations
  bool stop;                                ///< otherwise warn
};

io::SettingsTable run_limits_settings();

RunLimits run_limits(const io::Settings& settings);

}  // namespace riesel::scenarios
