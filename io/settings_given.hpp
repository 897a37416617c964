// What the user gave: the file and the overrides as one collection of keys, each known to the
// scenario's table. Values are not looked at yet.
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
  std::map<std::string, Place> sections;  ///< those that the file has
};

/// The entries of "key=value" texts, as the command line has them. Throws SettingsError.
std::vector<YamlEntry> parse_overrides(const std::vector<std::string>& texts);

/// `overrides` have dotted keys; they replace or add to what the file says, the last one of a key
/// wins; one without a value takes the key out. Notes unknown keys, and sections that are none;
/// throws SettingsError: no or an unknown scenario.
GivenSettings gather_settings(const YamlNode& file, const SettingsTables& tables,
                              const std::vector<YamlEntry>& overrides, Mistakes& mistakes);

}  // namespace riesel::io
