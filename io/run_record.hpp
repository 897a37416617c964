// attempts.json: how often a point of a sweep was started, and why it failed if it did.
//
// It is in the directory of the point and is written by the process that runs the point, so that
// many processes can work on one sweep. A run that failed for a reason would fail again; a run that
// was merely stopped has no failure here.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace riesel::io {

struct RunRecord {
  int attempts = 0;     ///< starts and resumes
  std::string failure;  ///< the reason; empty if the last attempt did not fail
  /// Changes of settings ("key=value") with which the last attempt was made.
  std::vector<std::string> changes = {};
};

/// The record of the run in `directory`; no attempts if there is none or it cannot be read.
RunRecord read_run_record(const std::filesystem::path& directory);

/// Throws FileError.
void write_run_record(const std::filesystem::path& directory, const RunRecord& record);

}  // namespace riesel::io
