// The reference page of the settings, written from the same rows that check them, so that the
// manual cannot be out of date.
#pragma once

#include "io/settings_table.hpp"

#include <string>

namespace riesel::io {

/// Markdown: the settings that all scenarios share, then those that several share, then those of
/// each scenario alone.
std::string settings_reference(const SettingsTables& tables);

}  // namespace riesel::io
