// What a Settings object holds, and how it is read. Internal to the settings.
#pragma once

#include "io/settings_error.hpp"
#include "io/settings_table.hpp"
#include "io/settings_value.hpp"
#include "io/settings_yaml.hpp"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace riesel::io {

struct SettingsContents {
  /// A row of the table whose condition holds, and what became of it.
  struct Entry {
    const Setting* row;                 ///< in `table`
    std::optional<SettingValue> value;  ///< given or by default
    std::optional<Place> given_at;      ///< place of the key
  };

  std::string source;                     ///< the file's name
  std::string source_text;                ///< verbatim, if it was read by itself
  const SettingsTable* table;             ///< of the scenario; points of a sweep share it
  std::map<std::string, Place> sections;  ///< that are present in the file
  std::vector<Entry> entries;             ///< in table order, no key twice

  /// nullptr if the table does not hold the key, or if it holds it only under unmet conditions.
  const Entry* find(const std::string& key) const;

  /// The place of the key; if it was not given, that of its innermost section in the file; if there
  /// is none, the beginning of the file.
  Place place_of(const std::string& key) const;
};

/// Without the source text. `tables` must outlive what is returned. Throws SettingsError.
SettingsContents read_settings(const YamlNode& file, const SettingsTables& tables,
                               const std::vector<YamlEntry>& overrides);

/// See Settings::effective_yaml().
std::string effective_yaml(const SettingsContents& contents,
                           const std::function<bool(const Setting&)>& wanted);

/// A value as effective.yaml writes it.
std::string written(const SettingsContents::Entry& entry);

}  // namespace riesel::io
