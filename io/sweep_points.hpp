// From a sweep file to its points: every combination of the places on the axes, the branches and
// the seeds, each with its full settings.
//
// A point runs in a directory named by a hash of what its results depend on: its settings and, if
// it continues a neighbour, that neighbour's name. So a run is found again however the sweep file
// is rearranged or extended, and equal points are one run.
//
// In a continuation, each combination of everything else is a chain: forward along the axis, and
// back again from its far end, each point from the final state of the one before. The two legs meet
// the same settings with different pasts, which is what shows hysteresis.
#pragma once

#include "io/settings.hpp"
#include "io/sweep_file.hpp"

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace riesel::io {

struct SweepPoint {
  Settings settings;  ///< checked; in a continuation, with the start of the chain's first point
  std::string yaml;   ///< the settings file of the run; a continued one starts from its parent
  std::string name;   ///< 16 hexadecimal digits; equal for points that are the same run
  std::optional<std::size_t> parent;  ///< index of the neighbour that it starts from
  std::string branch;                 ///< its name; empty if the sweep has none
  std::string leg;                    ///< "forward" or "backward" in a continuation, else empty
  /// The files by whose contents the name goes, each with hash_of_content().
  std::map<std::string, std::string> inputs = {};
};

constexpr std::size_t most_sweep_points = 10'000;

/// All points, a parent before its children. The order is that of the sweep file: axes first, then
/// branches, then seeds; the legs of a continuation come last. Throws SettingsError for values that
/// no run can have, and for a continuation if the scenario has none.
std::vector<SweepPoint> expand(const SweepFile& sweep, const SettingsTables& tables);

/// Whether the setting concerns only the first point of a chain: the others start from neighbours.
bool is_of_start(const std::string& key);

/// The keys whose values tell the points apart, in the order of the file; `seed` comes last. For a
/// section that a branch takes out, those of its keys that differ. `table`: of the scenario.
std::vector<std::string> varied_keys(const SweepFile& sweep, const SettingsTable& table,
                                     const std::vector<SweepPoint>& points);

}  // namespace riesel::io
