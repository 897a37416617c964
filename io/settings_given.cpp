#include "io/settings_given.hpp"

#include "io/settings_names.hpp"
#include "io/settings_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace riesel::io {
namespace {

std::string without_blanks_around(const std::string& text) {
  constexpr auto blanks = " \t";
  const auto begin = text.find_first_not_of(blanks);
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(blanks) + 1 - begin);
}

YamlEntry parse_override(const std::string& text) {
  const Place place = {std::string(override_mark) + text};
  const auto equals = text.find('=');
  const auto key = without_blanks_around(text.substr(0, equals));
  if (equals == std::string::npos || key.empty()) {
    throw SettingsError(place, "", "expected key=value", "write for instance --set seed=2");
  }
  return {key, place, parse_yaml_value(text.substr(equals + 1), place)};
}

/// A dotted key as a file has it: "run: {duration: ...}".
std::string in_sections(const std::string& key) {
  const auto dot = key.find('.');
  if (dot == std::string::npos) return key + ": ...";
  return fmt::format("{}: {{{}}}", key.substr(0, dot), in_sections(key.substr(dot + 1)));
}

/// What to do about a file without the key `row`, that of the scenario.
std::string remedy_without_scenario(const YamlNode& file, const Setting& row) {
  if (find_entry(file, "base") != nullptr) return "this is a sweep file: use 'riesel sweep'";
  for (const auto& entry : file.entries)
    if (nearest_name(entry.key, {row.key}))
      return fmt::format("write '{}' instead of '{}'", row.key, entry.key);
  return fmt::format("add '{}:' with {}", row.key, expectation(row));
}

/// The scenario decides which table applies, so it is read before anything else is checked.
std::string read_scenario(const YamlNode& file, const std::vector<YamlEntry>& overrides,
                          const SettingsTables& tables) {
  const Setting row = {
      .key = "scenario", .kind = Kind::choice, .choices = names_of_scenarios(tables)};

  const YamlNode* node = nullptr;
  for (const auto* entries : {&file.entries, &overrides}) {
    for (const auto& entry : *entries) {
      if (entry.key == row.key) node = &entry.value;
    }
  }
  if (node == nullptr) {
    throw SettingsError({file.place.source, 1, 1}, row.key, "is missing",
                        remedy_without_scenario(file, row));
  }
  return std::get<std::string>(read_value(row, *node));
}

/// Collects entries under the rules of one scenario.
class Gatherer {
public:
  Gatherer(std::string scenario, const SettingsTables& tables, Mistakes& mistakes)
      : tables_(tables), table_(tables.at(scenario)), mistakes_(mistakes) {
    given_.scenario = std::move(scenario);
  }

  void add_file(const YamlNode& file) { add_entries("", file.entries); }

  void add_override(const YamlEntry& entry) {
    const bool takes_out = entry.value.shape == YamlNode::Shape::null;
    if (has_section(table_, entry.key)) {
      if (takes_out) {
        std::erase_if(given_.by_key,
                      [&](const auto& given) { return given.first.starts_with(entry.key + "."); });
        return;
      }
      const auto example = key_of(entry.key, names_of(table_, entry.key).front());
      const bool on_command_line = entry.key_place.line == 0;
      throw SettingsError(entry.key_place, entry.key, "is a section and has no value of its own",
                          on_command_line
                              ? fmt::format("override its keys, as in --set {}=...", example)
                              : fmt::format("give its keys, such as {}", example));
    }
    if (takes_out && given_.by_key.erase(entry.key) > 0) return;
    add(entry.key, entry);
  }

  GivenSettings take() { return std::move(given_); }

private:
  void add_entries(const std::string& section, const std::vector<YamlEntry>& entries) {
    for (const auto& entry : entries) mistakes_.note([&] { add_entry(section, entry); });
  }

  void add_entry(const std::string& section, const YamlEntry& entry) {
    const auto key = key_of(section, entry.key);
    const bool is_dotted = entry.key.find('.') != std::string::npos;
    if (has_section(table_, key)) {
      add_section(key, entry);
    } else if (is_dotted && has_section(table_, section_of(key))) {
      throw SettingsError(entry.key_place, key, "dotted keys are for --set only",
                          fmt::format("write '{}'", in_sections(key)));
    } else {
      add(key, entry);
    }
  }

  void add_section(const std::string& key, const YamlEntry& section) {
    if (section.value.shape != YamlNode::Shape::map) {
      const auto example = key_of(key, names_of(table_, key).front());
      throw SettingsError(section.value.place, key,
                          "expected a section with keys, got " + describe(section.value),
                          fmt::format("write '{}'", in_sections(example)));
    }
    given_.sections.emplace(key, section.key_place);
    add_entries(key, section.value.entries);
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
  Mistakes& mistakes_;
  GivenSettings given_;
};

}  // namespace

std::vector<YamlEntry> parse_overrides(const std::vector<std::string>& texts) {
  std::vector<YamlEntry> overrides;
  for (const auto& text : texts) overrides.push_back(parse_override(text));
  return overrides;
}

GivenSettings gather_settings(const YamlNode& file, const SettingsTables& tables,
                              const std::vector<YamlEntry>& overrides, Mistakes& mistakes) {
  Gatherer gatherer(read_scenario(file, overrides, tables), tables, mistakes);
  gatherer.add_file(file);
  for (const auto& entry : overrides) mistakes.note([&] { gatherer.add_override(entry); });
  return gatherer.take();
}

bool may_count(const Setting& row, const GivenSettings& given, const SettingsTable& table) {
  if (!row.only_when) return true;
  const auto& [key, values] = *row.only_when;
  const auto entry = given.by_key.find(key);
  const auto condition = std::ranges::find(table, key, &Setting::key);
  const auto value = entry != given.by_key.end() ? entry->second.value.scalar : condition->fallback;
  return std::ranges::find(values, value) != values.end() && may_count(*condition, given, table);
}

}  // namespace riesel::io
