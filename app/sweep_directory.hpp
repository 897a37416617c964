// The directory of a sweep, and the state of the sweep as its files alone show it: each point has a
// directory of its own below points/, which says how far the point has come.
#pragma once

#include "io/run_record.hpp"
#include "io/settings.hpp"
#include "io/sweep_manifest.hpp"

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace riesel::app {

enum class RunStatus {
  waiting,      ///< not started yet
  running,      ///< a process is working on it
  done,         ///< it has a summary, which is not cut short
  failed,       ///< for a reason that would occur again
  interrupted,  ///< stopped; goes on from its checkpoint, or from the start if there is none
};

std::string to_string(RunStatus status);

/// According to the manifest, which is a snapshot, see refresh().
bool has_status(const io::ManifestPoint& point, RunStatus status);

struct RunStanding {
  RunStatus status = RunStatus::waiting;
  int attempts = 0;
  std::string reason;  ///< why it failed, or why it waits
};

std::filesystem::path point_directory(const std::filesystem::path& sweep, const std::string& name);

/// The summary of the run in the directory of a point; while it goes on, or if it has failed to,
/// the one from before. There may be neither.
std::filesystem::path summary_of(const std::filesystem::path& point);

/// The copy of the sweep file in the directory of the sweep.
inline constexpr auto sweep_file_name = "sweep.yaml";

/// The settings file of a point, within its directory.
inline constexpr auto point_settings_name = "point.yaml";

/// The settings that riesel wrote for a point, in a file of its directory. Throws
/// io::SettingsError if they cannot be read.
io::Settings settings_of_point(const std::filesystem::path& file);

/// The manifest of the sweep in this directory. Throws UnusableInput if it cannot be read.
io::Manifest manifest_in(const std::filesystem::path& sweep);

/// Why the files of a point cannot be reached, as for want of permission; "" if they can, or if
/// there are none.
std::string obstacle_at(const std::filesystem::path& point);

/// How far the point in this directory has come. One that cannot be reached counts as failed.
RunStanding standing_of(const std::filesystem::path& point);
/// The same, with another record than that in the directory.
RunStanding standing_of(const std::filesystem::path& point, const io::RunRecord& record);

/// Whether a point is among those with these `names`: all if empty.
bool is_among(const std::vector<std::string>& names, const std::string& point);

/// Brings status, attempts and reason of the points with these `names` up to date from the
/// directories.
void refresh(io::Manifest& manifest, const std::filesystem::path& sweep,
             const std::vector<std::string>& names = {});

/// Whether some runs start from the ends of others. Such runs cannot be extended.
bool has_chains(const io::Manifest& manifest);

/// Marks those of the points with these `names` as failed whose directories hold the results of
/// other settings than theirs, as after a mistake in moving directories. Returns their names.
std::set<std::string> note_misplaced(io::Manifest& manifest, const std::filesystem::path& sweep,
                                     const std::vector<std::string>& names = {});

/// Why a run of the point that begins or goes on now would not be the planned one, as its settings
/// or a file that it reads have changed, or its directory is another one's; or why it could not
/// begin. "" if nothing is seen. The neighbour that it starts from must be done.
std::string reason_not_to_start(const io::Manifest& manifest, const io::ManifestPoint& point,
                                const std::filesystem::path& sweep);

/// Throws UnusableInput if a file has changed that any point reads, among those with these `names`,
/// that has yet to begin.
void reject_changed_inputs(const io::Manifest& manifest, const std::filesystem::path& sweep,
                           const std::vector<std::string>& names);

/// Whether a run of the point can go on from a checkpoint.
bool can_resume(const std::filesystem::path& point);

/// Whether the run of the point can be started, or go on: not if it is out of reach, nor if it has
/// a result, but no checkpoint to go on from.
bool can_begin(const std::filesystem::path& point);

/// Removes the files of a run that cannot go on, so that it can be started again; does nothing if
/// the run is done, or can go on after all. Throws io::FileError if a process is working on it.
void clear(const std::filesystem::path& point);

}  // namespace riesel::app
