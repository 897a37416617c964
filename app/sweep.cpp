// riesel sweep: many runs from one file. sweep-task: one of them, for a batch system that has its
// own queue.
#include "app/commands.hpp"
#include "app/cost.hpp"
#include "app/exit_status.hpp"
#include "app/print_sweep.hpp"
#include "app/sweep_collect.hpp"
#include "app/sweep_directory.hpp"
#include "app/sweep_parts.hpp"
#include "app/sweep_plan.hpp"
#include "app/sweep_runner.hpp"
#include "app/terminal.hpp"
#include "io/directory_lock.hpp"
#include "io/durable_file.hpp"
#include "io/file_error.hpp"
#include "io/run_file.hpp"
#include "io/run_record.hpp"
#include "io/shell_words.hpp"

#include <fmt/core.h>
#include <omp.h>

#include <fstream>
#include <iterator>

namespace riesel::app {

namespace fs = std::filesystem;

namespace {

bool holds(const fs::path& file, const std::string& content) {
  std::ifstream stream(file, std::ios::binary);
  return stream && std::string(std::istreambuf_iterator<char>(stream), {}) == content;
}

/// The sweep file, the manifest, and for each point its directory with its settings.
void write_plan(const SweepPlan& plan, const fs::path& sweep) {
  for (std::size_t i = 0; i < plan.settings.size(); ++i) {
    const fs::path point = point_directory(sweep, plan.manifest.points[i].name);
    io::make_directories(point);
    const fs::path file = point / point_settings_name;
    if (!holds(file, plan.settings[i])) io::write_durably(file, plan.settings[i]);
  }
  io::write_durably(sweep / sweep_file_name, plan.sweep_file);
  io::write_durably(sweep / io::manifest_name, io::to_json(plan.manifest));
}

/// Not over a run, and not twice at a time.
io::DirectoryLock lock(const fs::path& sweep) {
  if (fs::exists(sweep / io::run_file_name))
    throw UnusableInput(sweep.string() + ": holds a run; choose another directory with --out");
  io::make_directories(sweep);
  return io::DirectoryLock(sweep);
}

int cores() { return omp_get_max_threads(); }

io::Manifest manifest_in(const fs::path& sweep) {
  return as_input([&] { return io::read_manifest(sweep); });
}

void reject_waiting_for_neighbour(const io::ManifestPoint& point, const fs::path& sweep) {
  if (point.parent.empty()) return;
  if (standing_of(point_directory(sweep, point.parent)).status == RunStatus::done) return;
  throw UnusableInput(fmt::format("{}: the point starts from its neighbour {}, which is not done; "
                                  "run that one first",
                                  point.name, point.parent));
}

/// An array of Slurm's default size, where nobody can be asked.
constexpr std::size_t usual_most_tasks = 1000;

/// As they stand in the directories. Slurm's tasks leave out what has failed, unless it is to be
/// tried again.
void refresh_for_slurm(io::Manifest& manifest, const fs::path& sweep, bool retry_failed) {
  refresh(manifest, sweep);
  if (!retry_failed) return;
  for (io::ManifestPoint& point : manifest.points)
    if (point.status == to_string(RunStatus::failed))
      point.status = to_string(RunStatus::interrupted);
}

/// What failed counts as stopped from now on: tasks go on with that. If they were told to try again
/// what has failed, they would do so each time they are queued.
void forget_failures(const io::Manifest& manifest, const fs::path& sweep) {
  for (const io::ManifestPoint& point : manifest.points) {
    const fs::path directory = point_directory(sweep, point.name);
    if (standing_of(directory).status != RunStatus::failed) continue;
    const int attempts = io::read_run_record(directory).attempts;
    io::write_run_record(directory, {.attempts = attempts, .failure = ""});
  }
}

int show_slurm_script(const io::Manifest& manifest, const fs::path& sweep,
                      const SweepOptions& options) {
  const std::size_t most = most_tasks_of_slurm().value_or(usual_most_tasks);
  const std::string script =
      slurm_script(manifest, sweep, options.slurm, options.max_walltime, most);
  fmt::print("{}", script.empty() ? "# nothing is left to be done\n" : script);
  return exit_done;
}

int submit(const io::Manifest& manifest, const fs::path& sweep, const SweepOptions& options) {
  const auto most = most_tasks_of_slurm();
  if (!most)
    throw UnusableInput("--slurm: scontrol does not answer; call this on a machine with Slurm, or "
                        "see --prepare for other batch systems");
  const std::string script =
      slurm_script(manifest, sweep, options.slurm, options.max_walltime, *most);
  if (script.empty()) {
    print_status(manifest, sweep);
    return exit_done;
  }
  io::make_directories(sweep / "slurm");
  io::write_durably(sweep / slurm_script_name, script);
  if (options.retry_failed) forget_failures(manifest, sweep);
  fmt::print("{}: submitted as job {}; see 'riesel status {}'\n", sweep.string(),
             submit_to_slurm(sweep / slurm_script_name), io::in_quotes(sweep.string()));
  return exit_done;
}

/// Which points a task is for.
std::vector<std::string> names_for(const SweepTaskOptions& options, const io::Manifest& manifest) {
  const std::size_t count = options.parts.value_or(manifest.points.size());
  if (options.index >= count)
    throw UnusableInput(fmt::format("{}: has no {} {}; give an index from 0 to {}",
                                    options.directory.string(), options.parts ? "part" : "point",
                                    options.index, count - 1));
  if (options.parts) return parts_of(manifest, count)[options.index];
  const io::ManifestPoint& point = manifest.points[options.index];
  reject_waiting_for_neighbour(point, options.directory);
  return {point.name};
}

}  // namespace

int sweep(const SweepOptions& options) {
  const fs::path directory = options.directory.value_or("sweeps" / options.file.stem());
  SweepPlan plan = plan_sweep(options.file);
  const int jobs = options.jobs.value_or(cores());
  if (options.dry_run) {
    if (options.to_slurm) {
      refresh_for_slurm(plan.manifest, directory, options.retry_failed);
      return show_slurm_script(plan.manifest, directory, options);
    }
    refresh(plan.manifest, directory);
    print_plan(plan.manifest, directory, jobs);
    return exit_done;
  }
  const io::DirectoryLock locked = lock(directory);
  write_plan(plan, directory);
  if (options.prepare_only) {
    fmt::print("{}: {} points are ready for 'riesel sweep-task'\n", directory.string(),
               plan.manifest.points.size());
    return exit_done;
  }
  if (options.to_slurm) {
    refresh_for_slurm(plan.manifest, directory, options.retry_failed);
    return submit(plan.manifest, directory, options);
  }
  const auto write_manifest = [&](const io::Manifest& manifest) {
    locked.require_in_place();
    io::write_durably(directory / io::manifest_name, io::to_json(manifest));
  };
  const int status = run_points(plan.manifest, directory, {},
                                {.jobs = jobs,
                                 .cores = cores(),
                                 .retry_failed = options.retry_failed,
                                 .max_walltime = options.max_walltime,
                                 .on_change = write_manifest});
  write_table(plan.manifest, directory);
  print_status(plan.manifest, directory);
  if (status > exit_bad_input) tell("interrupted; the same command goes on from there\n");
  return status;
}

int sweep_task(const SweepTaskOptions& options) {
  io::Manifest manifest = manifest_in(options.directory);
  const std::vector<std::string> names = names_for(options, manifest);
  if (names.empty()) return exit_done;  // more parts than there are points
  const int status = run_points(manifest, options.directory, names,
                                {.jobs = 1,
                                 .cores = options.threads.value_or(cores()),
                                 .retry_failed = options.retry_failed,
                                 .max_walltime = options.max_walltime});
  for (const std::string& name : names) {
    const RunStanding standing = standing_of(point_directory(options.directory, name));
    fmt::print("point {}: {}{}{}\n", name, to_string(standing.status),
               standing.reason.empty() ? "" : ": ", standing.reason);
  }
  return status;
}

int sweep_status(const fs::path& directory) {
  io::Manifest manifest = manifest_in(directory);
  refresh(manifest, directory);
  print_status(manifest, directory);
  return exit_done;
}

int sweep_collect(const fs::path& directory) {
  io::Manifest manifest = manifest_in(directory);
  refresh(manifest, directory);
  write_table(manifest, directory);
  print_status(manifest, directory);
  return exit_done;
}

}  // namespace riesel::app
