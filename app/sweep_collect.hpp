// The table of a sweep: for each point its settings that vary, its status, and all numbers of its
// summary.
#pragma once

#include "io/sweep_manifest.hpp"

#include <filesystem>

namespace riesel::app {

/// Writes sweep.csv and sweep.h5 into the directory of the sweep. The manifest must be up to date,
/// see refresh(); points whose directories hold other results become failed in it, see
/// note_misplaced(). Returns whether all summaries that are there were taken. Throws io::FileError,
/// io::SettingsError if the sweep file is missing.
bool write_table(io::Manifest& manifest, const std::filesystem::path& sweep);

}  // namespace riesel::app
