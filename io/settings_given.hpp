// What the user gave: the file and the overrides as one collection of keys, each known to the
// scenario's table. Values are not read yet.
#pragma once

#include "io/settings_table.hpp"
#include "io/settings_yaml.hpp"

#include <map>
#include <string>
#include <vector>

namespace riesel::io {

struct GivenSettings {
  std::string scenario;
  std::map<std::string, YamlEntry> by_key;
  std::map<std::string, Place> sections;  ///< that are present in the file
};

/// The entries of "key=value" texts from the command line. Throws SettingsError.
std::vector<YamlEntry> parse_overrides(const std::vector<std::string>& texts);

/// `overrides` have dotted keys; they replace or add to what the file says, the last one for a key
/// wins; one without a value removes the key. Unknown keys, and values where sections belong, go to
/// `mistakes`. Throws SettingsError if the scenario is missing or unknown.
GivenSettings gather_settings(const YamlNode& file, const SettingsTables& tables,
                              const std::vector<YamlEntry>& overrides, Mistakes& mistakes);

/// Whether the row applies, as far as what is given and the defaults tell.
bool may_count(const Setting& row, const GivenSettings& given, const SettingsTable& table);

}  // namespace riesel::io
