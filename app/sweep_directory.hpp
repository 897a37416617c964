// The directory of a sweep and what can be told from it without asking anyone: each point has a
// directory of its own below points/, and that says how far the point has come.
#pragma once

#include "io/sweep_manifest.hpp"

#include <filesystem>
#include <string>

namespace riesel::app {

enum class RunStatus {
  waiting,      ///< nothing was done yet
  running,      ///< a process works on it
  done,         ///< its summary is there
  failed,       ///< for a reason that would come again
  interrupted,  ///< stopped; goes on from its checkpoint, if there is one
};

std::string to_string(RunStatus status);

/// By the snapshot in the manifest.
bool has_status(const io::ManifestPoint& point, RunStatus status);

struct RunStanding {
  RunStatus status = RunStatus::waiting;
  int attempts = 0;
  std::string reason;  ///< why it failed, or why it waits
};

std::filesystem::path point_directory(const std::filesystem::path& sweep, const std::string& name);

/// The sweep file as it was, in the directory of the sweep.
inline constexpr auto sweep_file_name = "sweep.yaml";

/// The settings file of a point, within its directory.
inline constexpr auto point_settings_name = "point.yaml";

/// What was planned for the directory. Throws UnusableInput if there is no sweep in it.
io::Manifest manifest_in(const std::filesystem::path& sweep);

RunStanding standing_of(const std::filesystem::path& point);

/// Brings the snapshot in the manifest up to date from the directories.
void refresh(io::Manifest& manifest, const std::filesystem::path& sweep);

/// Whether a run of the point can go on from a checkpoint.
bool can_resume(const std::filesystem::path& point);

/// Removes what a run has left that can not go on, so that it can be started again; nothing if it
/// is done. Throws io::FileError if a process works on it.
void clear(const std::filesystem::path& point);

}  // namespace riesel::app
