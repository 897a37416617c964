// Quantities in settings: numbers with or without a unit, and the ways to write several of them.
#pragma once

#include "io/settings_table.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace riesel::io {

struct YamlNode;

/// Of one setting. Few enough that effective.yaml, which writes out each one, is short enough for
/// this program to read.
inline constexpr std::int64_t most_values = 10'000;

/// The value in the row's unit, finite and in its range. Throws SettingsError at the node's place.
double read_quantity(const Setting& row, const YamlNode& node);

/// From a list of quantities, a single one, or {from, to, points, spacing}, whose first and last
/// values are exactly `from` and `to`. Never empty. Throws SettingsError at the place of what is
/// wrong.
std::vector<double> read_quantities(const Setting& row, const YamlNode& node);

/// "a length such as '0.66 mm' or a number in m"
std::string expected_quantity(const Setting& row);

}  // namespace riesel::io
