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

/// Throws SettingsError: bad YAML, no or an unknown scenario, unknown keys, sections that are none.
GivenSettings gather_settings(const std::string& text, const std::string& source,
                              const SettingsTables& tables,
                              const std::vector<std::string>& overrides);

}  // namespace riesel::io
