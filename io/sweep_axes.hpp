// The axes of a sweep file. Internal to reading it.
#pragma once

#include "io/settings_given.hpp"
#include "io/settings_table.hpp"
#include "io/settings_yaml.hpp"
#include "io/sweep_file.hpp"

#include <vector>

namespace riesel::io {

/// Of a map, each key is an axis of its own; of a list of maps, each map is an axis whose keys vary
/// together. The values of a key are a list, or the range of a quantity. `given`: the settings
/// without the axes; they decide which unit a range has where that depends on another setting.
/// Throws SettingsError.
std::vector<SweepAxis> read_axes(const YamlNode& node, const GivenSettings& given,
                                 const SettingsTables& tables);

}  // namespace riesel::io
