// A settings file to begin with, from the rows that also check it: what has no default is given,
// all else stands there as a comment.
#pragma once

#include "io/settings_table.hpp"

#include <string>

namespace riesel::io {

/// YAML. `summary`: what the scenario is, one sentence.
std::string starter_file(const SettingsTable& table, const std::string& scenario,
                         const std::string& summary);

}  // namespace riesel::io
