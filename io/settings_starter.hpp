// A settings file to begin with, made from the same rows that check it: settings that have a
// `starter` are given, all others appear as comments.
#pragma once

#include "io/settings_table.hpp"

#include <string>

namespace riesel::io {

/// YAML. `summary`: what the scenario is, one sentence.
std::string starter_file(const SettingsTable& table, const std::string& scenario,
                         const std::string& summary);

}  // namespace riesel::io
