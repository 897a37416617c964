// The settings as a JSON Schema (draft-07), made from the same rows that check them: what editors
// with a YAML language server need to complete keys, show their meaning and mark mistakes.
//
// The schema is stricter than the program in one way: it knows only the usual units of each
// dimension, where the program takes whatever UDUNITS-2 knows. And it cannot check what the table
// does not hold: conditions between several settings, and whether a number is finite.
#pragma once

#include "io/settings_table.hpp"

#include <string>

namespace riesel::io {

/// JSON, for settings files of all scenarios.
std::string settings_schema(const SettingsTables& tables);

/// JSON, for sweep files.
std::string sweep_schema(const SettingsTables& tables);

/// A regular expression for quantities as text: a number and, optionally, a unit of the dimension
/// of `si_unit`. If that is empty, no unit matches; if its dimension is not known here, any does.
std::string quantity_pattern(const std::string& si_unit, bool may_be_negative);

}  // namespace riesel::io
