// summary.json read back.
#pragma once

#include "io/summary.hpp"

#include <filesystem>
#include <string>
#include <variant>

namespace riesel::io {

using Summary = std::variant<FlowSummary, CurveSummary, ColumnSummary>;

/// What to do about a damaged summary: from the last checkpoint of a run riesel makes the same
/// anew.
std::string remedy_for_summary(const std::filesystem::path& path);

/// What to_json() wrote, with null read as NaN. Verdicts and thresholds are those of the file, the
/// wording of a finding is that of this program. Throws FileError if the file cannot be read, is
/// damaged, or has another format than summary_format.
Summary read_summary(const std::filesystem::path& path);

}  // namespace riesel::io
