// Runs the points of a sweep side by side.
//
// Each is a process (child_process.hpp) with an equal share of the cores: one thread while there
// are at least as many points to run as cores, more when there are fewer. The point that takes
// longest goes first; for a chain of continued runs, the time of the whole rest of the chain
// counts. All that must not be lost is in the directories of the points, so that the runner itself
// can die at any moment.
#pragma once

#include "app/prolongation.hpp"
#include "app/sweep_directory.hpp"
#include "io/sweep_manifest.hpp"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace riesel::app {

/// The number of cores of this machine, or that OMP_NUM_THREADS allows.
int cores();

struct SweepRunOptions {
  int jobs = 1;                             ///< processes at the same time
  int cores = 1;                            ///< shared by them
  bool retry_failed = false;                ///< start failed points again
  std::optional<double> max_walltime = {};  ///< s of real time since the program started
  Prolongation prolongation = {};           ///< for points that are done, too
  /// If there is one, called now and then, and at the end, with the snapshot in the manifest up to
  /// date.
  std::function<void(const io::Manifest&)> on_change = {};
};

/// Runs those points that have not come to their end, but none that failed before (see options).
/// `names`: which points; all if empty. Returns exit_done if all of them are done, exit_failed if
/// not, exit_out_of_time if the time was over, 128 + signal if interrupted. Brings these points in
/// the manifest up to date.
int run_points(io::Manifest& manifest, const std::filesystem::path& sweep,
               const std::vector<std::string>& names, const SweepRunOptions& options);

}  // namespace riesel::app
