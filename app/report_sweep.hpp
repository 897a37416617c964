// The report of a sweep: its figures, and a table of its points with their verdicts and links to
// their runs.
#pragma once

#include "app/report_parts.hpp"
#include "io/summary_reader.hpp"
#include "io/sweep_manifest.hpp"

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace riesel::app {

struct SweepResult {
  std::optional<io::Summary> summary;  ///< nothing if the point is not done, or it cannot be read
  std::string flaw;                    ///< why it cannot be read, or ""
  std::string directory;               ///< of the point, relative to that of the sweep
  bool has_report = false;

  /// The summary, if there is one of this kind.
  template <class Kind>
  const Kind* as() const {
    return summary ? std::get_if<Kind>(&*summary) : nullptr;
  }
};

/// What a sweep has left so far.
struct SweepRecord {
  io::Manifest manifest;             ///< up to date, see refresh()
  std::vector<SweepResult> results;  ///< one for each point, in the order of the manifest
  std::string sweep_file;            ///< its text
};

/// Equal records give equal reports, byte by byte. At least one result must have a summary.
Report make_report(const SweepRecord& record);

}  // namespace riesel::app
