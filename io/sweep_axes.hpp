// The axes of a sweep file. Internal to reading it.
#pragma once

#include "io/settings_given.hpp"
#include "io/settings_table.hpp"
#include "io/settings_yaml.hpp"
#include "io/sweep_file.hpp"

#include <vector>

namespace riesel::io {

/// From a map, each of its keys an axis of its own, or from a list of maps, the keys of one map
/// zipped. The values of a key are a list, or the range of a quantity. `given` are the settings
/// without the axes: they decide which unit a range has where that depends on another setting.
/// Throws SettingsError.
std::vector<SweepAxis> read_axes(const YamlNode& node, const GivenSettings& given,
                                 const SettingsTables& tables);

}  // namespace riesel::io
