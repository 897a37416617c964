// The report of a sweep: its figures, and the table of its points with their verdicts, each with
// the way to its run.
#pragma once

#include "app/report_parts.hpp"
#include "io/summary_reader.hpp"
#include "io/sweep_manifest.hpp"

#include <optional>
#include <string>
#include <vector>

namespace riesel::app {

struct SweepResult {
  std::optional<io::Summary> summary;  ///< none if the point is not done, or cannot be read
  std::string flaw;                    ///< why it cannot be read; or empty
  std::string directory;               ///< relative to that of the sweep
  bool has_report = false;
};

/// What a sweep has left so far.
struct SweepRecord {
  io::Manifest manifest;             ///< up to date
  std::vector<SweepResult> results;  ///< of each point
  std::string sweep_file;            ///< its text
};

/// Equal records give equal reports, byte by byte.
Report make_report(const SweepRecord& record);

}  // namespace riesel::app
