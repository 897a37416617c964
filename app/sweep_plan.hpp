// From a sweep file to the plan of the sweep. Every point is checked as its run would check it,
// except for the state of a neighbour that it will start from, and its cost is estimated.
#pragma once

#include "io/sweep_manifest.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace riesel::app {

struct SweepPlan {
  io::Manifest manifest;
  std::vector<std::string> settings;  ///< for each point of the manifest, its settings file
  std::string sweep_file;             ///< its text, verbatim
};

/// Writes nothing to disk. Throws io::SettingsError.
SweepPlan plan_sweep(const std::filesystem::path& file);

}  // namespace riesel::app
