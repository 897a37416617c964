// The subcommands of riesel, one file each. They return the exit status, and throw
// io::SettingsError or UnusableInput for bad input, anything else where a run fails.
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

/// What read() returns; what it cannot use is bad input, rather than a failure. Throws
/// UnusableInput instead of io::FileError.
template <class Read>
auto as_input(Read read) {
  try {
    return read();
  } catch (const io::FileError& error) {
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
  /// "key=value"; only what does not make it another run: duration, threads, stepping, limits, how
  /// often checkpoints are written.
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
  std::vector<std::string> overrides;              ///< "key=value", to go on with, see Prolongation
  std::optional<int> jobs;                         ///< runs side by side [as many as cores]
  bool dry_run = false;                            ///< only tell what would be run
  bool prepare_only = false;                       ///< write the plan, run nothing
  bool retry_failed = false;                       ///< run again what failed
  std::optional<double> max_walltime;  ///< s on the clock: of the command, or of a task of Slurm
  bool to_slurm = false;               ///< leave the running to Slurm
  SlurmOptions slurm;
};

int sweep(const SweepOptions& options);

struct SweepTaskOptions {
  std::filesystem::path directory;     ///< of a sweep that was prepared
  std::size_t index = 0;               ///< of the point, as --dry-run lists them; or of the part
  std::optional<std::size_t> parts;    ///< how many the sweep is cut into, see sweep_parts.hpp
  std::optional<int> threads;          ///< [as many as cores, if that many are of use]
  std::optional<double> max_walltime;  ///< s on the clock, to stop before; from the program's start
  bool retry_failed = false;
  std::vector<std::string> overrides;  ///< "key=value", to go on with, see Prolongation
};

int sweep_task(const SweepTaskOptions& options);

/// How far the sweep in a directory has come.
int sweep_status(const std::filesystem::path& directory);

/// Gathers the results of the sweep in a directory into one table.
int sweep_collect(const std::filesystem::path& directory);

/// Writes a page with figures beside the files of the finished run, or of the sweep, in a
/// directory.
int report(const std::filesystem::path& directory);

int list_scenarios();

struct NewFileOptions {
  std::string scenario;
  std::optional<std::filesystem::path> file;  ///< [SCENARIO.yaml]
};

/// Writes a settings file to begin with.
int new_file(const NewFileOptions& options);

/// The reference page of the settings, in Markdown.
int print_settings();

/// The JSON Schema of settings files, or of sweep files.
int print_schema(bool of_sweeps);

}  // namespace riesel::app
