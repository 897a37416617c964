// manifest.json: what a sweep consists of and how far it has come, for people, scripts and for
// `riesel status`, `collect` and `sweep-task`, which then need no sweep file.
//
// The points with their settings and directories are the plan and do not change while a sweep runs.
// Their status is a snapshot; the truth is in the directories of the runs.
#pragma once

#include "io/settings.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <variant>
#include <vector>

namespace riesel::io {

/// A cell of a table: empty, a number, or a text.
using Cell = std::variant<std::monostate, double, std::string>;

/// A setting in which the points differ.
struct VariedSetting {
  std::string key;   ///< dotted
  std::string unit;  ///< SI; "1" or empty for what has none
};

struct ManifestPoint {
  std::string name;          ///< of its directory in points/; equal for equal runs
  std::string parent;        ///< name of the run that it continues, or empty
  std::string branch;        ///< or empty
  std::string leg;           ///< forward, backward, or empty
  std::vector<Cell> values;  ///< of the varied settings, in their order
  /// Files that are read when the run begins, with hash_of_content() at the time of the plan.
  std::map<std::string, std::string> inputs = {};
  double expected_seconds{};  ///< s, on one thread
  int most_threads = 1;       ///< more would not make it faster
  std::string status;         ///< at the time when the manifest was written
  int attempts = 0;           ///< how often it was started or resumed
  std::string reason;         ///< why it failed or waits; or empty
};

struct Manifest {
  std::vector<VariedSetting> varied;
  std::vector<ManifestPoint> points;
};

inline constexpr auto manifest_name = "manifest.json";

/// The value of a setting; quantities in SI units.
Cell cell_of(const Settings& settings, const std::string& key);

std::string to_json(const Manifest& manifest);

/// The text of a plan that is longer could not be read any more once it tells of failures.
inline constexpr std::size_t largest_plan = 16'000'000;  // bytes

/// Reads the manifest of the sweep in `directory`. Throws FileError if there is none or it cannot
/// be understood.
Manifest read_manifest(const std::filesystem::path& directory);

}  // namespace riesel::io
