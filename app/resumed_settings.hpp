// Which settings may change when a run goes on: those that leave its physics as it is.
#pragma once

#include "engine/state.hpp"
#include "io/settings.hpp"
#include "scenarios/run_length.hpp"

#include <string>
#include <vector>

namespace riesel::app {

/// Whether a setting may change.
bool may_change(const std::string& key);

/// `overrides`: "key=value". Throws io::SettingsError for a setting that may not change.
void reject_overrides_of_the_physics(const std::vector<std::string>& overrides);

/// The `overrides` without those that take out a setting ("key=") which has no value in the
/// settings `before`, so that a command that removes a setting may be repeated.
std::vector<std::string> changes_to(const io::Settings& before, std::vector<std::string> overrides);

/// The settings in `checkpoint` (YAML), changed by `overrides`; `source` names them in errors. See
/// also changes_to(). Throws io::SettingsError.
io::Settings resumed_settings(const std::string& checkpoint, const std::string& source,
                              const std::vector<std::string>& overrides);

/// The length of a run with these settings that goes on from `state`. Throws io::SettingsError for
/// more steps than can be counted, and for rows in step with the walls.
scenarios::RunLength resumed_length(const io::Settings& settings, const State& state);

}  // namespace riesel::app
