// Runs the points of a sweep side by side.
//
// Each is a process (child_process.hpp) with as many threads as the cores allow: one while there
// are as many points to run as cores, more where there are fewer. What takes longest goes first; in
// a chain of continued runs that is the whole rest of the chain. All that must not be lost is in
// the directories of the points, so that the runner itself can die at any moment.
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

/// Those of the machine, or as many as OMP_NUM_THREADS allows.
int cores();

struct SweepRunOptions {
  int jobs = 1;                             ///< processes at the same time
  int cores = 1;                            ///< shared by them
  bool retry_failed = false;                ///< start again what failed
  std::optional<double> max_walltime = {};  ///< s, since the program's start, to stop before
  Prolongation prolongation = {};           ///< of what is done, too
  /// Called now and then, and at the end, with the snapshot in the manifest up to date.
  std::function<void(const io::Manifest&)> on_change = [](const io::Manifest&) {};
};

/// Runs those points that have not come to their end, but none that failed before (see options).
/// `names`: which points; all if empty. Returns 0 if all of them are done, 1 if not, 3 if the time
/// was over, 128 + signal if interrupted. The manifest is up to date then.
int run_points(io::Manifest& manifest, const std::filesystem::path& sweep,
               const std::vector<std::string>& names, const SweepRunOptions& options);

}  // namespace riesel::app
