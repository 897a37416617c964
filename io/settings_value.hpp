// From the text of a value to the value: how a row of the table reads a node of the YAML tree.
#pragma once

#include "io/settings_table.hpp"

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace riesel::io {

struct YamlNode;

/// The word `auto` in place of an integer.
struct Auto {
  bool operator==(const Auto&) const = default;
};

/// A checked value: a number in the row's SI unit, an integer, a text or choice, a list of
/// numbers.
using SettingValue = std::variant<double, std::int64_t, std::string, std::vector<double>, Auto>;

/// The value of a node under the kind, unit, range and choices of the row. Throws SettingsError at
/// the node's place.
SettingValue read_value(const Setting& row, const YamlNode& node);

/// "a length such as '0.66 mm' or a number in m": what the row takes.
std::string expectation(const Setting& row);

/// Throws the SettingsError "expected ..., got ...; remedy" at the node's place.
[[noreturn]] void refuse_value(const Setting& row, const YamlNode& node, const std::string& remedy);

/// Throws SettingsError at the node's place if the value is outside the row's range.
void check_range(const Setting& row, const YamlNode& node, double value);

}  // namespace riesel::io
