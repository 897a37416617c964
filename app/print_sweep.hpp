// A sweep on the screen: its plan, and how far it has come.
#pragma once

#include "io/sweep_manifest.hpp"

#include <filesystem>

namespace riesel::app {

/// Prints every point with its index, directory, expected time, status and settings, and the
/// expected time of all with `jobs` runs side by side, without what has failed unless it is to be
/// tried again.
void print_plan(const io::Manifest& manifest, const std::filesystem::path& sweep, int jobs,
                bool retry_failed);

/// Prints how many points are done, running and so on, and the reasons why points failed or wait.
/// The manifest must be up to date, see refresh().
void print_status(const io::Manifest& manifest, const std::filesystem::path& sweep);

}  // namespace riesel::app
