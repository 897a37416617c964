// From a sweep file to its points: every combination of the places on the axes, the branches and
// the seeds, each with its whole settings.
//
// A point is run in a directory that is named by a hash of what its results depend on: its settings
// and, where it continues a neighbour, that neighbour's name. So a run is found again however the
// sweep file was rearranged or extended, and equal points are one run.
//
// In a continuation each combination of all else is a chain: forward along the axis, and back again
// from the far end, each point from the final state of the one before. The two legs meet the same
// settings with another past, which is what shows hysteresis.
#pragma once

#include "io/settings.hpp"
#include "io/sweep_file.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace riesel::io {

struct SweepPoint {
  Settings settings;  ///< checked; in a continuation with the start of the first
  std::string yaml;   ///< the settings file of the run; its start is the neighbour, if it has one
  std::string name;   ///< 16 hexadecimal digits; equal for points that are the same run
  std::optional<std::size_t> parent;  ///< index of the neighbour that it starts from
  std::string branch;                 ///< its name; empty if the sweep has none
  std::string leg;                    ///< "forward" or "backward" in a continuation, else empty
};

constexpr std::size_t most_sweep_points = 10'000;

/// All points, a parent before its children. The order is that of the sweep file: axes first, then
/// branches, then seeds; in a continuation its legs come last. Throws SettingsError for values that
/// no run can have, and for a continuation that the scenario does not know.
std::vector<SweepPoint> expand(const SweepFile& sweep, const SettingsTables& tables);

/// The keys whose values tell the points apart, in the order of the file; `seed` is the last one.
std::vector<std::string> varied_keys(const SweepFile& sweep);

}  // namespace riesel::io
