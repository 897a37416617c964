#include "io/settings_contents.hpp"

#include "io/settings_given.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>

namespace riesel::io {
namespace {

using Entry = SettingsContents::Entry;

/// Whether the condition is met. It refers to an earlier row (see verify_table()), which has a
/// value unless its own condition is unmet.
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
    return {&row, read_value(row, entry->second.value), entry->second.key_place};
  }
  if (row.required) {
    const auto condition = row.only_when ? fmt::format(", as {}", to_string(*row.only_when)) : "";
    throw SettingsError(contents.place_of(row.key), row.key, "is missing" + condition,
                        fmt::format("give {}", expectation(row)));
  }
  if (row.fallback.empty()) return {&row, {}, {}};
  return {&row, read_default(row), {}};
}

/// Why no row of a key applies: the first unmet one of the conditions that it depends on.
When unmet_condition(const std::string& key, const SettingsContents& contents) {
  const When condition = condition_of(*contents.table, key).value();
  return contents.find(condition.key) != nullptr ? condition
                                                 : unmet_condition(condition.key, contents);
}

/// Whether a setting was given on the command line, not in the file.
bool is_override(const std::optional<Place>& place) {
  return place && place->source.starts_with(override_mark);
}

/// A setting without effect would misrepresent the run.
void refuse_idle_setting(const std::string& key, const Place& place,
                         const SettingsContents& contents) {
  const When condition = unmet_condition(key, contents);
  const Entry& decisive = *contents.find(condition.key);
  const bool overridden = is_override(decisive.given_at) && !is_override(place);
  throw SettingsError(place, key,
                      fmt::format("has no effect when {} is {}", condition.key,
                                  std::get<std::string>(decisive.value.value())),
                      fmt::format("remove it{}; it applies only when {}",
                                  overridden ? fmt::format(", here by --set {}=", key) : "",
                                  to_string(condition)));
}

/// Reads the rows of a table one by one, and goes on after mistakes.
class RowReader {
public:
  RowReader(const GivenSettings& given, SettingsContents& contents, Mistakes& mistakes)
      : given_(given), contents_(contents), mistakes_(mistakes) {}

  void read(const Setting& row) {
    if (row.only_when && unknown_.contains(row.only_when->key)) {
      unknown_.insert(row.key);
      return;
    }
    if (row.only_when && !holds(*row.only_when, contents_)) return;
    // A setting that seems to be missing may have been given under a misspelt key.
    const bool is_given = given_.by_key.contains(row.key);
    const bool may_be_misspelt = row.required && !is_given && mistakes_.any();
    const auto read = [&] { contents_.entries.push_back(read_row(row, given_, contents_)); };
    if (may_be_misspelt || !mistakes_.note(read)) unknown_.insert(row.key);
  }

  void refuse_idle_settings() {
    for (const auto& given : given_.by_key) {
      const std::string& key = given.first;
      if (contents_.find(key) != nullptr || unknown_.contains(key)) continue;
      mistakes_.note([&] { refuse_idle_setting(key, given.second.key_place, contents_); });
    }
  }

private:
  const GivenSettings& given_;
  SettingsContents& contents_;
  Mistakes& mistakes_;
  std::set<std::string> unknown_;  // keys of unknown value, or unknown whether they apply
};

}  // namespace

const Entry* SettingsContents::find(const std::string& key) const {
  const auto entry = std::ranges::find(
      entries, key, [](const Entry& e) -> const std::string& { return e.row->key; });
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

SettingsContents read_settings(const YamlNode& file, const SettingsTables& tables,
                               const std::vector<YamlEntry>& overrides) {
  Mistakes mistakes;
  const auto given = gather_settings(file, tables, overrides, mistakes);
  SettingsContents contents = {.source = file.place.source,
                               .source_text = {},
                               .table = &tables.at(given.scenario),
                               .sections = given.sections,
                               .entries = {}};
  RowReader reader(given, contents, mistakes);
  for (const auto& row : *contents.table) reader.read(row);
  reader.refuse_idle_settings();
  mistakes.throw_if_any();
  return contents;
}

}  // namespace riesel::io
