// The start of a flow from a file of grains: places, velocities and sizes, a grain per row.
#pragma once

#include "engine/state.hpp"
#include "io/settings.hpp"

#include <vector>

namespace riesel::scenarios {

/// The grains of the file at `start.from`. `empty` has the box and the walls, but no grains. Throws
/// io::SettingsError, with file, line and column, for a grain outside the tube, in a wall grain or
/// in another grain.
std::vector<Grain> grains_of_file(const io::Settings& settings, const State& empty);

}  // namespace riesel::scenarios
