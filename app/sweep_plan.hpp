// From a sweep file to the plan: every point checked as its run would check it, and its cost.
#pragma once

#include "io/sweep_manifest.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace riesel::app {

struct SweepPlan {
  io::Manifest manifest;
  std::vector<std::string> settings;  ///< of each point of the manifest, a settings file
  std::string sweep_file;             ///< verbatim
};

/// Writes nothing. Throws SettingsError.
SweepPlan plan_sweep(const std::filesystem::path& file);

}  // namespace riesel::app
