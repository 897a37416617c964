// Beyond what a run is to be stopped, or the user warned: settings of scenarios that are flows.
#pragma once

#include "io/settings.hpp"

#include <optional>

namespace riesel::scenarios {

struct RunLimits {
  std::optional<double> overlap;            ///< LargestOverlap::ratio
  std::optional<double> energy_error;       ///< see energy_error_ratio()
  std::optional<double> speed;              ///< m/s, of any grain
  std::optional<double> steps_per_contact;  ///< at least, of the shortest twentieth of the contacts
  bool stop;                                ///< or warn
};

io::SettingsTable run_limits_settings();

RunLimits run_limits(const io::Settings& settings);

}  // namespace riesel::scenarios
