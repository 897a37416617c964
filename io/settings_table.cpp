#include "io/settings_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace riesel::io {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

[[noreturn]] void contradiction(const Setting& row, const std::string& problem) {
  throw std::logic_error(fmt::format("settings table: {}: {}", row.key, problem));
}

void append_once(std::vector<std::string>& names, const std::string& name) {
  if (std::ranges::find(names, name) == names.end()) names.push_back(name);
}

/// What follows the prefix in the keys that begin with it, up to the next dot.
std::vector<std::string> names_below(const SettingsTable& table, const std::string& prefix) {
  std::vector<std::string> names;
  for (const auto& row : table) {
    if (!row.key.starts_with(prefix)) continue;
    const auto rest = row.key.substr(prefix.size());
    append_once(names, rest.substr(0, rest.find('.')));
  }
  return names;
}

bool exclude_each_other(const Setting& a, const Setting& b) {
  if (!a.only_when || !b.only_when || a.only_when->key != b.only_when->key) return false;
  return std::ranges::find_first_of(a.only_when->values, b.only_when->values)
         == a.only_when->values.end();
}

/// The condition must refer to an earlier row, so that one pass in table order decides which rows
/// apply. Where that row does not apply, this one does not either.
void verify_condition(const Setting& row, const SettingsTable& earlier_rows) {
  const auto condition_row = std::ranges::find(earlier_rows, row.only_when->key, &Setting::key);
  if (condition_row == earlier_rows.end() || condition_row->kind != Kind::choice
      || condition_row->fallback.empty()) {
    contradiction(row, "depends on " + row.only_when->key
                           + ", which is not an earlier choice with a default");
  }
  for (const auto& value : row.only_when->values) {
    if (std::ranges::find(condition_row->choices, value) == condition_row->choices.end()) {
      contradiction(row, fmt::format("{} is never {}", row.only_when->key, value));
    }
  }
}

void verify_row(const Setting& row, const SettingsTable& earlier_rows) {
  if (row.key.empty() || std::ranges::count(row.key, '.') > 2) contradiction(row, "bad key");
  if (!row.doc.ends_with('.')) contradiction(row, "the doc does not end with a full stop");
  if (row.required && !row.fallback.empty()) contradiction(row, "required, but has a default");
  if ((row.kind == Kind::choice) == row.choices.empty()) {
    contradiction(row, "choices belong to the kind choice, and only to it");
  }
  if (has_section(earlier_rows, row.key) || has_key(earlier_rows, section_of(row.key)))
    contradiction(row, "a section is not a key");
  if (row.only_when) verify_condition(row, earlier_rows);
  for (const auto& earlier : earlier_rows) {
    if (earlier.key == row.key && !exclude_each_other(earlier, row))
      contradiction(row, "appears twice");
  }
}

}  // namespace

bool Range::contains(double value) const {
  const bool above = low_open ? value > low : value >= low;
  const bool below = high_open ? value < high : value <= high;
  return above && below;
}

Range any() { return {}; }
Range positive() { return {.low = 0.0, .low_open = true}; }
Range non_negative() { return {.low = 0.0}; }
Range at_least(double low) { return {.low = low}; }
Range between(double low, double high) { return {.low = low, .high = high}; }
Range above_up_to(double low, double high) { return {.low = low, .high = high, .low_open = true}; }

void verify_table(const SettingsTable& table) {
  SettingsTable earlier_rows;
  for (const auto& row : table) {
    verify_row(row, earlier_rows);
    earlier_rows.push_back(row);
  }
}

std::string section_of(const std::string& key) {
  const auto dot = key.rfind('.');
  return dot == std::string::npos ? "" : key.substr(0, dot);
}

std::string name_in_section(const std::string& key) { return key.substr(key.rfind('.') + 1); }

std::string key_of(const std::string& section, const std::string& name) {
  return section.empty() ? name : section + "." + name;
}

bool has_key(const SettingsTable& table, const std::string& key) {
  return std::ranges::find(table, key, &Setting::key) != table.end();
}

bool has_section(const SettingsTable& table, const std::string& section) {
  return !section.empty() && !names_of(table, section).empty();
}

std::optional<When> condition_of(const SettingsTable& table, const std::string& key) {
  std::optional<When> any;
  for (const auto& row : table) {
    if (row.key != key || !row.only_when) continue;
    if (!any) any = When{row.only_when->key, {}};  // common to all rows of a key
    any->values.insert(any->values.end(), row.only_when->values.begin(),
                       row.only_when->values.end());
  }
  return any;
}

std::vector<std::string> names_of_scenarios(const SettingsTables& tables) {
  std::vector<std::string> names;
  for (const auto& [name, table] : tables) names.push_back(name);
  return names;
}

std::vector<std::string> names_of(const SettingsTable& table, const std::string& section) {
  return names_below(table, key_of(section, ""));
}

std::string to_string(const Range& range, const std::string& unit) {
  const bool has_unit = !unit.empty() && unit != "1";
  const bool is_angle = unit == "rad";
  const double scale = is_angle ? 180.0 / std::numbers::pi : 1.0;
  const auto end = [&](double value) {
    return fmt::format("{}{}", value * scale, is_angle ? " degrees" : (has_unit ? " " + unit : ""));
  };
  const bool has_low = range.low != -infinity;
  const bool has_high = range.high != infinity;
  if (has_low && has_high && !range.low_open && !range.high_open) {
    return fmt::format("from {} to {}", range.low * scale, end(range.high));
  }
  auto low = fmt::format("{} {}", range.low_open ? "above" : "at least", end(range.low));
  auto high = fmt::format("{} {}", range.high_open ? "below" : "at most", end(range.high));
  if (has_low && has_high) return low + " and " + high;
  if (has_low) return low;
  if (has_high) return high;
  return "";
}

std::string to_string(const When& when) {
  return fmt::format("{} is {}", when.key, fmt::join(when.values, " or "));
}

}  // namespace riesel::io
