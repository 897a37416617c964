// riesel sweep: many runs from one file; or a sweep that was begun, which goes on.
#include "app/commands.hpp"
#include "app/exit_status.hpp"
#include "app/plain_words.hpp"
#include "app/print_sweep.hpp"
#include "app/prolongation.hpp"
#include "app/sweep_collect.hpp"
#include "app/sweep_directory.hpp"
#include "app/sweep_plan.hpp"
#include "app/sweep_runner.hpp"
#include "app/terminal.hpp"
#include "io/directory_lock.hpp"
#include "io/durable_file.hpp"
#include "io/file_error.hpp"
#include "io/run_file.hpp"
#include "io/run_record.hpp"
#include "io/shell_words.hpp"
#include "io/sweep_table.hpp"
#include "io/whole_file.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace riesel::app {

namespace fs = std::filesystem;

namespace {

bool holds(const fs::path& file, const std::string& content) {
  return io::beginning_of(file, content.size() + 1) == content;
}

/// Writes the directory and the settings of a point.
void write_point(const fs::path& point, const std::string& settings) {
  io::make_directories(point);
  const fs::path file = point / point_settings_name;
  if (!holds(file, settings)) io::write_durably(file, settings);
}

/// Writes all points, the sweep file and the manifest. Returns whether that was possible for all
/// points: one that was there before and cannot be written any more is told, and fails later.
bool write_plan(SweepPlan& plan, const fs::path& sweep) {
  bool all_written = true;
  for (std::size_t i = 0; i < plan.settings.size(); ++i) {
    const fs::path point = point_directory(sweep, plan.manifest.points[i].name);
    const bool was_there = fs::exists(fs::symlink_status(point));
    try {
      write_point(point, plan.settings[i]);
    } catch (const io::FileError& error) {
      if (!was_there) throw;
      tell("riesel: {}\n", error.what());
      all_written = false;
    }
  }
  const fs::path copy = sweep / sweep_file_name;  // somebody may have written notes into it
  if (!holds(copy, plan.sweep_file)) io::write_durably(copy, plan.sweep_file, io::Previous::keep);
  refresh(plan.manifest, sweep);  // some points may be done
  note_misplaced(plan.manifest, sweep);
  io::write_durably(sweep / io::manifest_name, io::to_json(plan.manifest));
  return all_written;
}

/// The points of the sweep that was here before; none if its manifest cannot be read, as that is
/// then written anew.
std::vector<io::ManifestPoint> points_before(const fs::path& sweep) {
  try {
    io::Manifest earlier = io::read_manifest(sweep);
    refresh(earlier, sweep);  // tasks do not update the manifest
    return earlier.points;
  } catch (const io::FileError&) {
    return {};
  }
}

/// Whether a run of the point is going on or has come to anything.
bool has_begun(const io::ManifestPoint& point, const fs::path& sweep) {
  if (!has_status(point, RunStatus::failed)) return !has_status(point, RunStatus::waiting);
  const fs::path directory = point_directory(sweep, point.name);
  return !obstacle_at(directory).empty() || has_checkpoint(directory);
}

/// Tells of points that were here and are not in this sweep: their runs stay, but no table lists
/// them any more. Throws UnusableInput if that holds for all points and some have begun.
void heed_earlier_sweep(const SweepPlan& plan, const fs::path& sweep) {
  const std::vector<io::ManifestPoint> earlier = points_before(sweep);
  const auto is_gone = [&](const io::ManifestPoint& point) {
    return std::ranges::find(plan.manifest.points, point.name, &io::ManifestPoint::name)
           == plan.manifest.points.end();
  };
  const auto gone = std::ranges::count_if(earlier, is_gone);
  const bool any_begun =
      std::ranges::any_of(earlier, [&](const auto& point) { return has_begun(point, sweep); });
  if (gone > 0 && gone == std::ssize(earlier) && any_begun)
    throw UnusableInput(sweep.string()
                        + ": holds another sweep that has no point in common with this one; choose "
                          "another directory with --out");
  if (gone > 0)
    tell("{}: {} of {} points that were here are not in this sweep; their runs stay\n",
         sweep.string(), gone, earlier.size());
}

void reject_directory_of_run(const fs::path& sweep) {
  if (fs::exists(sweep / io::run_file_name))
    throw UnusableInput(sweep.string() + ": holds a run; choose another directory with --out");
}

/// Where no sweep has been, files with the names of those of a sweep are somebody else's, unless it
/// is this sweep that has lost its manifest.
void reject_files_of_others(const SweepPlan& plan, const fs::path& sweep) {
  const bool has_points = fs::is_directory(point_directory(sweep, ""));
  const bool is_sweep = has_points && fs::exists(sweep / io::manifest_name);
  if (is_sweep || holds(sweep / sweep_file_name, plan.sweep_file)) return;
  for (const fs::path& file : {sweep / io::manifest_name, sweep / sweep_file_name,
                               sweep / io::sweep_csv_name, sweep / io::sweep_h5_name})
    if (fs::exists(file))
      throw UnusableInput(file.string()
                          + ": is not of this sweep, and would be overwritten; move it away, or "
                            "choose another directory with --out");
}

/// Locks the directory against a second sweep.
io::DirectoryLock lock(const fs::path& sweep) {
  io::make_directories(sweep);
  return as_input<io::InUse>([&] { return io::DirectoryLock(sweep); });
}

/// For --dry-run where scontrol cannot be asked: about Slurm's default MaxArraySize.
constexpr std::size_t usual_most_tasks = 1000;

/// Brings the manifest up to date. Slurm's tasks leave out failed points. If these are to be tried
/// again, points that failed in a run count as interrupted; other failures cannot be forgotten, see
/// forget_failures().
void refresh_for_slurm(io::Manifest& manifest, const fs::path& sweep,
                       const Prolongation& prolongation, bool retry_failed) {
  prolongation.look_ahead(manifest, sweep);
  if (!retry_failed) return;
  for (io::ManifestPoint& point : manifest.points) {
    const bool failed = has_status(point, RunStatus::failed);
    if (failed && !io::read_run_record(point_directory(sweep, point.name)).failure.empty())
      point.status = to_string(RunStatus::interrupted);
  }
}

/// The records of runs, by directory.
using Records = std::map<fs::path, io::RunRecord>;

Records records_of_failed(const io::Manifest& manifest, const fs::path& sweep,
                          const Prolongation& prolongation) {
  Records records;
  for (const io::ManifestPoint& point : manifest.points) {
    const fs::path directory = point_directory(sweep, point.name);
    const io::RunRecord record = io::read_run_record(directory);
    if (!record.failure.empty() && prolongation.standing_of(directory).status == RunStatus::failed)
      records.emplace(directory, record);
  }
  return records;
}

/// Removes the failures from the records, so that tasks treat these runs as interrupted. (Tasks
/// called with --retry-failed would try again each time they are queued.)
void forget_failures(const Records& failed) {
  for (const auto& [directory, record] : failed)
    io::write_run_record(directory, {.attempts = record.attempts, .failure = ""});
}

/// Submits the script and returns the number of the job. Failures are forgotten before that, as
/// tasks may begin at once, and restored if there is no job.
std::string submitted_job(const io::Manifest& manifest, const fs::path& sweep,
                          const Prolongation& prolongation, bool retry_failed) {
  const Records failed =
      retry_failed ? records_of_failed(manifest, sweep, prolongation) : Records();
  try {
    forget_failures(failed);
    return submit_to_slurm(sweep / slurm_script_name);
  } catch (const std::runtime_error&) {
    for (const auto& [directory, record] : failed) io::write_run_record(directory, record);
    throw;
  }
}

int show_slurm_script(const io::Manifest& manifest, const fs::path& sweep,
                      const SweepOptions& options) {
  const std::size_t most = most_tasks_of_slurm().value_or(usual_most_tasks);
  const std::string script =
      slurm_script(manifest, sweep, options.overrides, options.slurm, options.max_walltime, most);
  fmt::print("{}", script.empty() ? "# nothing is left to be done\n" : script);
  return exit_done;
}

/// Prints what would be done; writes nothing.
int show_plan(io::Manifest& manifest, const fs::path& sweep, const Prolongation& prolongation,
              const SweepOptions& options, int jobs) {
  if (options.to_slurm) {
    refresh_for_slurm(manifest, sweep, prolongation, options.retry_failed);
    return show_slurm_script(manifest, sweep, options);
  }
  prolongation.look_ahead(manifest, sweep);
  print_plan(manifest, sweep, jobs, options.retry_failed);
  return exit_done;
}

/// The number of tasks that an array can have. Throws UnusableInput where there is no Slurm.
std::size_t required_most_tasks() {
  const auto most = most_tasks_of_slurm();
  if (!most)
    throw UnusableInput("--slurm: scontrol does not answer; call this on a machine with Slurm, or "
                        "see --prepare for other batch systems");
  return *most;
}

int submit(const io::Manifest& manifest, const fs::path& sweep, const Prolongation& prolongation,
           const SweepOptions& options, std::size_t most) {
  const std::string script =
      slurm_script(manifest, sweep, options.overrides, options.slurm, options.max_walltime, most);
  if (script.empty()) {
    print_status(manifest, sweep);
    const auto is_done = [](const auto& point) { return has_status(point, RunStatus::done); };
    return std::ranges::all_of(manifest.points, is_done) ? exit_done : exit_failed;
  }
  io::make_directories(sweep / "slurm");
  io::write_durably(sweep / slurm_script_name, script);
  const std::string job = submitted_job(manifest, sweep, prolongation, options.retry_failed);
  fmt::print("{}: submitted{}; see '{}'\n", sweep.string(), job.empty() ? "" : " as job " + job,
             call_of("status", sweep));
  return exit_done;
}

int run_here(io::Manifest& manifest, const fs::path& sweep, const io::DirectoryLock& locked,
             const Prolongation& prolongation, const SweepOptions& options, int jobs) {
  const auto write_manifest = [&](const io::Manifest& now) {
    locked.require_in_place();
    io::write_durably(sweep / io::manifest_name, io::to_json(now));
  };
  const int status = run_points(manifest, sweep, {},
                                {.jobs = jobs,
                                 .cores = cores(),
                                 .retry_failed = options.retry_failed,
                                 .max_walltime = options.max_walltime,
                                 .prolongation = prolongation,
                                 .on_change = write_manifest});
  const bool all_taken = write_table(manifest, sweep);
  print_status(manifest, sweep);
  if (status == exit_done && !all_taken) return exit_failed;
  if (was_stopped(status)) tell("interrupted; the same command goes on from there\n");
  return status;
}

/// The plan of a sweep that was begun, with its manifest only, as all files of it must be there,
/// except those of points out of reach, which fail. Throws UnusableInput if one is missing.
SweepPlan plan_in(const fs::path& sweep) {
  SweepPlan plan{.manifest = manifest_in(sweep), .settings = {}, .sweep_file = {}};
  std::vector<fs::path> files = {sweep / sweep_file_name};
  for (const io::ManifestPoint& point : plan.manifest.points) {
    const fs::path directory = point_directory(sweep, point.name);
    if (obstacle_at(directory).empty()) files.push_back(directory / point_settings_name);
  }
  for (const fs::path& file : files) {
    if (fs::exists(file) && !fs::is_regular_file(file))
      throw UnusableInput(file.string() + ": is no regular file; remove it");
    if (!fs::exists(file))
      throw UnusableInput(file.string() + ": is missing; call '" + call_of("sweep")
                          + "' with the sweep file, which makes it anew, and --out "
                          + io::path_argument(sweep));
  }
  return plan;
}

void reject_options_in_vain(const SweepOptions& options, bool begun) {
  if (begun && options.directory)
    throw UnusableInput("--out: the sweep in " + options.file.string()
                        + " goes on where it is; leave the option out");
  if (!begun && !options.overrides.empty() && fs::exists(options.file))
    throw UnusableInput(
        "--set: is only for continuing a sweep; give the directory of the sweep instead of the "
        "file, or write the setting into the file, below 'set:'");
}

bool has_line_break(const std::string& text) {
  return text.find_first_of("\r\n") != std::string::npos;
}

/// The script for Slurm has a line for each option, among them the name of the directory.
void reject_line_breaks(const SlurmOptions& options, const fs::path& sweep) {
  if (std::ranges::any_of(options.for_sbatch, has_line_break))
    throw UnusableInput("--sbatch: has a line break; give each option by an --sbatch of its own");
  if (has_line_break(fs::absolute(sweep).string()))
    throw UnusableInput("--slurm: the path of the sweep has a line break, which no script for "
                        "Slurm can hold; choose another directory with --out");
}

}  // namespace

int sweep(const SweepOptions& options) {
  const bool begun = fs::is_directory(options.file);
  reject_options_in_vain(options, begun);
  const fs::path directory = begun               ? options.file
                             : options.directory ? *options.directory
                                                 : place_named_after(options.file, "sweeps");
  if (options.to_slurm) reject_line_breaks(options.slurm, directory);
  SweepPlan plan = begun ? plan_in(directory) : plan_sweep(options.file);
  const Prolongation prolongation(plan.manifest, directory, {}, options.overrides);
  const int jobs = options.jobs.value_or(cores());
  reject_directory_of_run(directory);
  if (begun) reject_changed_inputs(plan.manifest, directory, {});
  if (!begun) reject_files_of_others(plan, directory);
  if (options.dry_run) {
    if (!begun) heed_earlier_sweep(plan, directory);
    return show_plan(plan.manifest, directory, prolongation, options, jobs);
  }
  // Asked before anything is written.
  const std::size_t most_tasks = options.to_slurm ? required_most_tasks() : 0;
  const io::DirectoryLock locked = lock(directory);
  if (!begun) heed_earlier_sweep(plan, directory);
  const bool all_written = begun || write_plan(plan, directory);
  if (options.prepare_only) {
    if (!all_written) return exit_failed;
    fmt::print("{}: {} points are ready for '{}'\n", directory.string(),
               plan.manifest.points.size(), call_of("sweep-task"));
    return exit_done;
  }
  if (options.to_slurm) {
    refresh_for_slurm(plan.manifest, directory, prolongation, options.retry_failed);
    return submit(plan.manifest, directory, prolongation, options, most_tasks);
  }
  return run_here(plan.manifest, directory, locked, prolongation, options, jobs);
}

}  // namespace riesel::app
