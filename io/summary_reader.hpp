// summary.json read back.
#pragma once

#include "io/summary.hpp"

#include <filesystem>

namespace riesel::io {

/// What to_json() wrote of a flow; null is not a number again. The findings of validity are judged
/// anew from their values, which gives their thresholds and words, and must come out as they are
/// written. Throws FileError if the file cannot be read, is damaged, of an impact scenario, or of
/// a version of riesel that judges otherwise.
FlowSummary read_flow_summary(const std::filesystem::path& path);

}  // namespace riesel::io
