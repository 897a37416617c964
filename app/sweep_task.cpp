// riesel sweep-task: one point of a sweep, or a part of its points, for a batch system that has its
// own queue.
#include "app/commands.hpp"
#include "app/exit_status.hpp"
#include "app/prolongation.hpp"
#include "app/sweep_directory.hpp"
#include "app/sweep_parts.hpp"
#include "app/sweep_runner.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace riesel::app {

namespace fs = std::filesystem;

namespace {

void reject_waiting_for_neighbour(const io::ManifestPoint& point, io::Manifest manifest,
                                  const fs::path& sweep) {
  if (point.parent.empty()) return;
  const bool is_done = standing_of(point_directory(sweep, point.parent)).status == RunStatus::done;
  if (is_done && note_misplaced(manifest, sweep, {point.parent}).empty()) return;
  throw UnusableInput(fmt::format("{}: the point starts from its neighbour {}, which is not done; "
                                  "run that one first",
                                  point.name, point.parent));
}

/// The names of the points that a task has to run.
std::vector<std::string> names_for(const SweepTaskOptions& options, const io::Manifest& manifest) {
  const std::size_t count = options.parts.value_or(manifest.points.size());
  if (options.index >= count)
    throw UnusableInput(fmt::format("{}: has no {} {}; give an index from 0 to {}",
                                    options.directory.string(), options.parts ? "part" : "point",
                                    options.index, count - 1));
  if (options.parts) return parts_of(manifest, count)[options.index];
  const io::ManifestPoint& point = manifest.points[options.index];
  reject_waiting_for_neighbour(point, manifest, options.directory);
  return {point.name};
}

/// `manifest`: as run_points() has left it, which knows failures that could not be recorded.
RunStanding standing_after(const std::string& name, const io::Manifest& manifest,
                           const fs::path& sweep, const Prolongation& prolongation) {
  const auto point = std::ranges::find(manifest.points, name, &io::ManifestPoint::name);
  if (has_status(*point, RunStatus::failed))
    return {.status = RunStatus::failed, .attempts = point->attempts, .reason = point->reason};
  return prolongation.standing_of(point_directory(sweep, name));
}

}  // namespace

int sweep_task(const SweepTaskOptions& options) {
  io::Manifest manifest = manifest_in(options.directory);
  const std::vector<std::string> names = names_for(options, manifest);
  if (names.empty()) return exit_done;  // there are more parts than chains of points
  const Prolongation prolongation(manifest, options.directory, names, options.overrides);
  reject_changed_inputs(manifest, options.directory, names);
  const int status = run_points(manifest, options.directory, names,
                                {.jobs = 1,
                                 .cores = options.threads.value_or(cores()),
                                 .retry_failed = options.retry_failed,
                                 .max_walltime = options.max_walltime,
                                 .prolongation = prolongation});
  for (const std::string& name : names) {
    const RunStanding standing = standing_after(name, manifest, options.directory, prolongation);
    fmt::print("point {}: {}{}{}\n", name, to_string(standing.status),
               standing.reason.empty() ? "" : ": ", standing.reason);
  }
  return status;
}

}  // namespace riesel::app
