// A sweep on the screen: its plan, and how far it has come.
#pragma once

#include "io/sweep_manifest.hpp"

#include <filesystem>

namespace riesel::app {

/// Every point with its directory and its expected time, and the expected time of all.
void print_plan(const io::Manifest& manifest, const std::filesystem::path& sweep, int jobs);

/// How many points are done, running and so on, and why those that failed did. The manifest must be
/// up to date.
void print_status(const io::Manifest& manifest, const std::filesystem::path& sweep);

}  // namespace riesel::app
