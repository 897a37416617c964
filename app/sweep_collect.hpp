// The table of a sweep: for each point its settings that vary, its status, and all numbers of its
// summary.
#pragma once

#include "io/sweep_manifest.hpp"

#include <filesystem>

namespace riesel::app {

/// Writes sweep.csv and sweep.h5 into the directory of the sweep. The manifest must be up to date,
/// see refresh(). Throws io::FileError.
void write_table(const io::Manifest& manifest, const std::filesystem::path& sweep);

}  // namespace riesel::app
