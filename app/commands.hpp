// The subcommands of riesel, one file each. They return the exit status. They throw
// io::SettingsError or UnusableInput for bad input, other exceptions if a run fails.
#pragma once

#include "app/flow_options.hpp"
#include "app/run_directory.hpp"
#include "app/slurm.hpp"
#include "io/file_error.hpp"
#include "io/settings.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace riesel::app {

/// A directory or checkpoint that cannot be used as the user wants.
class UnusableInput : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Returns read(). A file that it cannot use, or a directory that another process has (io::InUse),
/// counts as bad input, not as a failed run: throws UnusableInput in place of the Error.
template <class Error = io::FileError, class Read>
auto as_input(Read read) {
  try {
    return read();
  } catch (const Error& error) {
    throw UnusableInput(error.what());
  }
}

struct RunOptions {
  std::filesystem::path file;                      ///< the settings
  std::optional<std::filesystem::path> directory;  ///< where the results go
  std::vector<std::string> overrides;              ///< "key=value"
  FlowOptions flow;
};

int run(const RunOptions& options, const Arguments& arguments);

struct ResumeOptions {
  std::filesystem::path checkpoint;  ///< the file, or the directory of the run
  /// "key=value"; only settings that leave the physics as it is: duration or precision, threads,
  /// stepping, limits, the interval of checkpoints.
  std::vector<std::string> overrides;
  FlowOptions flow;
};

int resume(const ResumeOptions& options, const Arguments& arguments);

struct CheckOptions {
  std::filesystem::path file;          ///< the settings
  std::vector<std::string> overrides;  ///< "key=value"
};

int check(const CheckOptions& options);

struct SweepOptions {
  std::filesystem::path file;                      ///< the sweep file, or the directory of a sweep
  std::optional<std::filesystem::path> directory;  ///< where the results go
  std::vector<std::string> overrides;              ///< "key=value", see Prolongation
  std::optional<int> jobs;                         ///< runs side by side [as many as cores]
  bool dry_run = false;                            ///< only list what would be run
  bool prepare_only = false;                       ///< write the plan, run nothing
  bool retry_failed = false;                       ///< start failed points again
  std::optional<double> max_walltime;  ///< s of real time: for the command, or for each Slurm task
  bool to_slurm = false;               ///< leave the running to Slurm
  SlurmOptions slurm;
};

int sweep(const SweepOptions& options);

struct SweepTaskOptions {
  std::filesystem::path directory;     ///< of a sweep that was prepared
  std::size_t index = 0;               ///< of the point, as --dry-run lists them; or of the part
  std::optional<std::size_t> parts;    ///< how many the sweep is cut into, see sweep_parts.hpp
  std::optional<int> threads;          ///< [as many as cores, or fewer if more are of no use]
  std::optional<double> max_walltime;  ///< s of real time since the program started
  bool retry_failed = false;
  std::vector<std::string> overrides;  ///< "key=value", see Prolongation
};

int sweep_task(const SweepTaskOptions& options);

/// Prints how far the sweep in a directory has come.
int sweep_status(const std::filesystem::path& directory);

/// Gathers the results of the sweep in a directory into one table.
int sweep_collect(const std::filesystem::path& directory);

/// Writes report.html and its figures into the directory of a finished run, or of a sweep.
int report(const std::filesystem::path& directory);

int list_scenarios();

struct NewFileOptions {
  std::string scenario;
  std::optional<std::filesystem::path> file;  ///< [SCENARIO.yaml]
};

/// Writes a settings file for the user to start from.
int new_file(const NewFileOptions& options);

/// Prints the reference page of the settings, in Markdown.
int print_settings();

/// Prints the JSON Schema of settings files, or of sweep files.
int print_schema(bool of_sweeps);

}  // namespace riesel::app
