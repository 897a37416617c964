#include "app/sweep_directory.hpp"

#include "app/commands.hpp"
#include "app/run_directory.hpp"
#include "io/checkpoint.hpp"
#include "io/directory_lock.hpp"
#include "io/durable_file.hpp"
#include "io/run_file.hpp"
#include "io/run_record.hpp"
#include "io/summary.hpp"
#include "io/trajectory_file.hpp"

#include <fmt/core.h>

#include <map>

namespace riesel::app {

namespace fs = std::filesystem;

namespace {

/// Why a run that is neither running nor done counts as failed; "" if it does not.
std::string reason_to_fail(const fs::path& point, const io::RunRecord& record) {
  if (!record.failure.empty()) return record.failure;
  if (has_checkpoint(point) && !can_resume(point))
    return fmt::format("{} is missing beside its checkpoint; restore it, or begin the point anew "
                       "with --retry-failed",
                       io::run_file_name);
  return "";
}

/// Why a run waits in vain, as its neighbour will not come to its end; "" if it does not. Parents
/// must come before their children in `standings`.
std::string reason_to_wait(const io::ManifestPoint& point,
                           const std::map<std::string, RunStanding>& standings) {
  const auto parent = standings.find(point.parent);
  if (parent == standings.end() || parent->second.status == RunStatus::done) return "";
  const bool in_vain = parent->second.status == RunStatus::failed || !parent->second.reason.empty();
  return in_vain ? "its neighbour " + point.parent + " has not come to its end" : "";
}

}  // namespace

std::string to_string(RunStatus status) {
  switch (status) {
  case RunStatus::waiting:
    return "waiting";
  case RunStatus::running:
    return "running";
  case RunStatus::done:
    return "done";
  case RunStatus::failed:
    return "failed";
  case RunStatus::interrupted:
    return "interrupted";
  }
  return {};
}

bool has_status(const io::ManifestPoint& point, RunStatus status) {
  return point.status == to_string(status);
}

fs::path point_directory(const fs::path& sweep, const std::string& name) {
  return sweep / "points" / name;
}

io::Manifest manifest_in(const fs::path& sweep) {
  return as_input([&] { return io::read_manifest(sweep); });
}

RunStanding standing_of(const fs::path& point) {
  const io::RunRecord record = io::read_run_record(point);
  const auto with = [&](RunStatus status, const std::string& reason = "") {
    return RunStanding{.status = status, .attempts = record.attempts, .reason = reason};
  };
  if (io::DirectoryLock::is_held(point)) return with(RunStatus::running);
  if (fs::exists(point / io::summary_name)) return with(RunStatus::done);
  const std::string reason = reason_to_fail(point, record);
  if (!reason.empty()) return with(RunStatus::failed, reason);
  return with(record.attempts > 0 ? RunStatus::interrupted : RunStatus::waiting);
}

void refresh(io::Manifest& manifest, const fs::path& sweep) {
  std::map<std::string, RunStanding> standings;
  for (io::ManifestPoint& point : manifest.points) {
    RunStanding& standing = standings[point.name];
    standing = standing_of(point_directory(sweep, point.name));
    if (standing.status == RunStatus::waiting) standing.reason = reason_to_wait(point, standings);
    point.status = to_string(standing.status);
    point.attempts = standing.attempts;
    point.reason = standing.reason;
  }
}

bool can_resume(const fs::path& point) {
  return fs::exists(point / io::run_file_name) && has_checkpoint(point);
}

void clear(const fs::path& point) {
  const io::DirectoryLock lock(point);
  if (fs::exists(point / io::summary_name)) return;
  const fs::path checkpoint = point / io::checkpoint_name, post_mortem = point / post_mortem_name;
  for (const fs::path& file : {checkpoint, io::previous_generation(checkpoint), post_mortem,
                               io::previous_generation(post_mortem), point / io::run_file_name,
                               point / io::effective_settings_name, point / io::trajectory_name,
                               point / io::trajectory_index_name})
    fs::remove(file);
}

}  // namespace riesel::app
