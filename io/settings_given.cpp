#include "io/settings_given.hpp"

#include "io/settings_names.hpp"
#include "io/settings_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace riesel::io {
namespace {

YamlEntry parse_override(const std::string& text) {
  const Place place = {"--set " + text};
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw SettingsError(place, "", "expected key=value", "write for instance --set seed=2");
  }
  return {text.substr(0, equals), place, parse_yaml_value(text.substr(equals + 1), place)};
}

/// The scenario decides about the table, so it is looked for before anything else is checked.
std::string read_scenario(const YamlNode& file, const std::vector<YamlEntry>& overrides,
                          const SettingsTables& tables) {
  Setting row = {.key = "scenario", .kind = Kind::choice};
  for (const auto& [name, table] : tables) row.choices.push_back(name);

  const YamlNode* node = nullptr;
  for (const auto* entries : {&file.entries, &overrides}) {
    for (const auto& entry : *entries) {
      if (entry.key == row.key) node = &entry.value;
    }
  }
  if (node == nullptr) {
    throw SettingsError({file.place.source, 1, 1}, row.key, "is missing",
                        "add 'scenario:' with " + expectation(row));
  }
  return std::get<std::string>(read_value(row, *node));
}

/// Sorts entries into the collection, under the rules of one scenario.
class Gatherer {
public:
  Gatherer(std::string scenario, const SettingsTables& tables)
      : tables_(tables), table_(tables.at(scenario)) {
    given_.scenario = std::move(scenario);
  }

  void add_file(const YamlNode& file) {
    for (const auto& entry : file.entries) add_top_level(entry);
  }

  void add_override(const YamlEntry& entry) {
    if (has_section(table_, entry.key)) {
      const auto example = entry.key + "." + names_of(table_, entry.key).front();
      const bool on_command_line = entry.key_place.line == 0;
      throw SettingsError(entry.key_place, entry.key, "is a section and has no value of its own",
                          on_command_line
                              ? fmt::format("override its keys, as in --set {}=...", example)
                              : fmt::format("give its keys, such as {}", example));
    }
    add(entry.key, entry);
  }

  GivenSettings take() { return std::move(given_); }

private:
  void add_top_level(const YamlEntry& entry) {
    if (has_section(table_, entry.key)) {
      add_section(entry);
    } else if (has_section(table_, section_of(entry.key))) {
      throw SettingsError(entry.key_place, entry.key, "dotted keys are for --set only",
                          fmt::format("write '{}: {{{}: ...}}'", section_of(entry.key),
                                      name_in_section(entry.key)));
    } else {
      add(entry.key, entry);
    }
  }

  void add_section(const YamlEntry& section) {
    if (section.value.shape != YamlNode::Shape::map) {
      const auto example = names_of(table_, section.key).front();
      throw SettingsError(section.value.place, section.key,
                          "expected a section with keys, got " + describe(section.value),
                          fmt::format("write '{}: {{{}: ...}}'", section.key, example));
    }
    given_.sections.emplace(section.key, section.key_place);
    for (const auto& entry : section.value.entries) add(section.key + "." + entry.key, entry);
  }

  void add(const std::string& key, const YamlEntry& entry) {
    if (!has_key(table_, key)) {
      throw SettingsError(entry.key_place, key, "unknown key",
                          unknown_key_remedy(key, given_.scenario, tables_));
    }
    given_.by_key.insert_or_assign(key, entry);
  }

  const SettingsTables& tables_;
  const SettingsTable& table_;
  GivenSettings given_;
};

}  // namespace

std::vector<YamlEntry> parse_overrides(const std::vector<std::string>& texts) {
  std::vector<YamlEntry> overrides;
  for (const auto& text : texts) overrides.push_back(parse_override(text));
  return overrides;
}

GivenSettings gather_settings(const YamlNode& file, const SettingsTables& tables,
                              const std::vector<YamlEntry>& overrides) {
  Gatherer gatherer(read_scenario(file, overrides, tables), tables);
  gatherer.add_file(file);
  for (const auto& entry : overrides) gatherer.add_override(entry);
  return gatherer.take();
}

}  // namespace riesel::io
