// Which settings may change when a run goes on: those that do not make it another run.
#pragma once

#include "io/settings.hpp"

#include <string>
#include <vector>

namespace riesel::app {

/// `overrides`: "key=value". Throws SettingsError for one of what may not change.
void reject_overrides_of_the_physics(const std::vector<std::string>& overrides);

/// `checkpoint` is the text of the settings that a run has gone by, `source` its name in errors. An
/// override without a value of what is not there changes nothing: the run has gone on like this
/// before. Throws SettingsError.
io::Settings resumed_settings(const std::string& checkpoint, const std::string& source,
                              const std::vector<std::string>& overrides);

}  // namespace riesel::app
