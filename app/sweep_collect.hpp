// The table of a sweep: what varies, how each point stands, and all numbers of its summary.
#pragma once

#include "io/sweep_manifest.hpp"

#include <filesystem>

namespace riesel::app {

/// Writes sweep.csv and sweep.h5 into the directory of the sweep, from a manifest that is up to
/// date. Throws FileError.
void write_table(const io::Manifest& manifest, const std::filesystem::path& sweep);

}  // namespace riesel::app
