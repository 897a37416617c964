#include "io/settings_contents.hpp"

#include "io/settings_given.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace riesel::io {
namespace {

using Entry = SettingsContents::Entry;

/// Conditions refer to earlier rows, see verify_table(): those that count have a value.
bool holds(const When& when, const SettingsContents& contents) {
  const auto* entry = contents.find(when.key);
  if (entry == nullptr) return false;
  const auto& value = std::get<std::string>(entry->value.value());
  return std::ranges::find(when.values, value) != when.values.end();
}

SettingValue read_default(const Setting& row) {
  try {
    return read_value(row, parse_yaml_value(row.fallback, {"default"}));
  } catch (const SettingsError& error) {
    throw std::logic_error(fmt::format("settings table: {}", error.what()));
  }
}

Entry read_row(const Setting& row, const GivenSettings& given, const SettingsContents& contents) {
  if (const auto entry = given.by_key.find(row.key); entry != given.by_key.end()) {
    return {row, read_value(row, entry->second.value), entry->second.key_place};
  }
  if (row.required) {
    const auto condition = row.only_when ? fmt::format(", as {}", to_string(*row.only_when)) : "";
    throw SettingsError(contents.place_of(row.key), row.key, "is missing" + condition,
                        fmt::format("give {}", expectation(row)));
  }
  if (row.fallback.empty()) return {row, {}, {}};
  return {row, read_default(row), {}};
}

/// Why a row does not count: the first of the conditions that it depends on.
When unmet_condition(const std::string& key, const SettingsContents& contents) {
  const When& condition = std::ranges::find(contents.table, key, &Setting::key)->only_when.value();
  return contents.find(condition.key) != nullptr ? condition
                                                 : unmet_condition(condition.key, contents);
}

/// A setting without effect would be a lie about the run.
void refuse_idle_settings(const GivenSettings& given, const SettingsContents& contents) {
  for (const auto& [key, entry] : given.by_key) {
    if (contents.find(key) != nullptr) continue;
    const When condition = unmet_condition(key, contents);
    const auto actual = std::get<std::string>(contents.find(condition.key)->value.value());
    throw SettingsError(entry.key_place, key,
                        fmt::format("has no effect when {} is {}", condition.key, actual),
                        fmt::format("remove it; it applies only when {}", to_string(condition)));
  }
}

}  // namespace

const Entry* SettingsContents::find(const std::string& key) const {
  const auto entry = std::ranges::find(entries, key, [](const Entry& e) { return e.row.key; });
  return entry == entries.end() ? nullptr : &*entry;
}

Place SettingsContents::place_of(const std::string& key) const {
  const auto* entry = find(key);
  if (entry != nullptr && entry->given_at) return *entry->given_at;
  for (auto name = section_of(key); !name.empty(); name = section_of(name)) {
    if (const auto section = sections.find(name); section != sections.end()) return section->second;
  }
  return {source, 1, 1};
}

SettingsContents read_settings(const YamlNode& file, const std::string& text,
                               const SettingsTables& tables,
                               const std::vector<YamlEntry>& overrides) {
  const auto given = gather_settings(file, tables, overrides);
  SettingsContents contents = {
      file.place.source, text, tables.at(given.scenario), given.sections, {}};
  verify_table(contents.table);
  for (const auto& row : contents.table) {
    if (row.only_when && !holds(*row.only_when, contents)) continue;
    contents.entries.push_back(read_row(row, given, contents));
  }
  refuse_idle_settings(given, contents);
  return contents;
}

}  // namespace riesel::io
