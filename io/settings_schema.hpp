// The settings as a JSON Schema (draft-07), made from the rows that also check them: what editors
// with a YAML language server need to complete keys, show their meaning and mark mistakes.
//
// The schema is stricter than the program in one way: of units it knows the usual ones of each
// dimension, where the program takes whatever UDUNITS-2 knows. And it cannot see what the table
// does not hold: conditions between several settings, and whether a number is finite.
#pragma once

#include "io/settings_table.hpp"

#include <string>

namespace riesel::io {

/// JSON, for settings files of all scenarios.
std::string settings_schema(const SettingsTables& tables);

/// JSON, for sweep files.
std::string sweep_schema(const SettingsTables& tables);

/// The regular expression for quantities as text: a number and, if wanted, a unit of the dimension
/// of `si_unit`. Without an SI unit no unit fits; of dimensions that are not known here any.
std::string quantity_pattern(const std::string& si_unit, bool may_be_negative);

}  // namespace riesel::io
