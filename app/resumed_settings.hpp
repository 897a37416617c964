// Which settings may change when a run goes on: those that do not make it another run.
#pragma once

#include <string>
#include <vector>

namespace riesel::app {

/// `overrides`: "key=value". Throws SettingsError for one of what may not change.
void reject_overrides_of_the_physics(const std::vector<std::string>& overrides);

}  // namespace riesel::app
