// Which settings may change when a run goes on: those that leave its physics as it is.
#pragma once

#include "io/settings.hpp"

#include <string>
#include <vector>

namespace riesel::app {

/// Whether a setting may change.
bool may_change(const std::string& key);

/// `overrides`: "key=value". Throws io::SettingsError for a setting that may not change.
void reject_overrides_of_the_physics(const std::vector<std::string>& overrides);

/// The settings in `checkpoint` (YAML), changed by `overrides`; `source` names them in errors. An
/// override "key=" of a setting that has no value changes nothing, so that a command that removes a
/// setting may be repeated. Throws io::SettingsError.
io::Settings resumed_settings(const std::string& checkpoint, const std::string& source,
                              const std::vector<std::string>& overrides);

}  // namespace riesel::app
