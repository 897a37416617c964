// The start of a flow from a file of grains: places, velocities and sizes, a grain per row.
#pragma once

#include "engine/state.hpp"
#include "io/settings.hpp"
#include "scenarios/flow_start.hpp"

#include <vector>

namespace riesel::scenarios {

/// The grains of the file at `start.from`. Throws io::SettingsError for room that is too small for
/// them, and, with file, line and column, for a grain outside of it, in a wall grain or in another
/// grain.
std::vector<Grain> grains_of_file(const io::Settings& settings, const Room& room);

}  // namespace riesel::scenarios
