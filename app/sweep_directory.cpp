#include "app/sweep_directory.hpp"

#include "app/cell_text.hpp"
#include "app/commands.hpp"
#include "app/plain_words.hpp"
#include "app/resumed_settings.hpp"
#include "app/run_directory.hpp"
#include "io/checkpoint.hpp"
#include "io/content_hash.hpp"
#include "io/directory_lock.hpp"
#include "io/durable_file.hpp"
#include "io/file_error.hpp"
#include "io/run_file.hpp"
#include "io/settings_table.hpp"
#include "io/settings_text.hpp"
#include "io/summary.hpp"
#include "io/sweep_points.hpp"
#include "io/trajectory_file.hpp"
#include "io/whole_file.hpp"
#include "scenarios/scenario.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <system_error>
#include <vector>

namespace riesel::app {

namespace fs = std::filesystem;

namespace {

bool is_done(const fs::path& point) { return io::is_bracketed(point / io::summary_name); }

/// Why a run that is neither running nor done counts as failed; "" if it does not.
std::string reason_to_fail(const fs::path& point, const io::RunRecord& record) {
  if (!record.failure.empty()) return record.failure;
  if (fs::exists(point / io::summary_name) && !can_resume(point))
    return fmt::format("{} is damaged; restore it, or remove {} to begin anew", io::summary_name,
                       point.string());
  if (has_checkpoint(point) && !can_resume(point))
    return fmt::format("{} is missing beside its checkpoint; restore it, or begin the point anew "
                       "with --retry-failed",
                       io::run_file_name);
  return "";
}

/// Whether a path leads to a file that the point was planned with, or to one of equal content.
bool is_planned_input(const std::string& path, const io::ManifestPoint& point) {
  if (point.inputs.empty() || point.inputs.contains(path)) return true;
  const std::string content = io::hash_of_content(path);
  return std::ranges::any_of(point.inputs,
                             [&](const auto& planned) { return planned.second == content; });
}

/// "seed is 2 in its effective.yaml, not 1": a setting in which `file`, the settings of a run in
/// the directory of the point, is not what was planned; "" if there is none, or if it cannot be
/// read. What changes no result or may change when a run goes on does not count, nor does the start
/// of a chain where it is not at its first point; paths count by what they lead to.
std::string difference_from_plan(const io::ManifestPoint& point,
                                 const std::vector<io::VariedSetting>& varied,
                                 const fs::path& file) {
  constexpr auto start_from = "start.from";
  try {
    const io::Settings settings = settings_of_point(file);
    const io::SettingsTable& table = scenarios::settings_tables().at(settings.scenario());
    for (std::size_t i = 0; i < varied.size(); ++i) {
      const std::string& key = varied[i].key;
      const auto row = std::ranges::find(table, key, &io::Setting::key);
      if (row == table.end() || !row->matters || may_change(key)) continue;
      if (!point.parent.empty() && io::is_of_start(key)) continue;
      const io::Cell found = io::cell_of(settings, key);
      const bool as_planned = row->names_content && settings.has(key)
                                  ? is_planned_input(settings.text(key), point)
                                  : found == point.values[i];
      if (!as_planned)
        return fmt::format("{} is {} in its {}, not {}", key, text_of(found),
                           file.filename().string(), text_of(point.values[i]));
    }
    if (point.parent.empty()) return "";
    const std::string from = settings.has(start_from) ? settings.text(start_from) : "";
    if (fs::path(from).filename() != point.parent)
      return fmt::format("{} is not its neighbour {}", start_from, point.parent);
  } catch (const io::SettingsError&) {
  }
  return "";
}

/// Why the run with the settings `file` is not that of the point in whose directory it is; "" if
/// nothing tells.
std::string misplacement(const io::ManifestPoint& point,
                         const std::vector<io::VariedSetting>& varied, const fs::path& file) {
  const std::string difference = difference_from_plan(point, varied, file);
  if (difference.empty()) return "";
  return fmt::format("{} is of another point ({}); put the directories back in their places, or "
                     "remove this one to begin anew",
                     file.parent_path().string(), difference);
}

/// Why a run that begins now would not be the planned one, as a file that it reads has changed; ""
/// if none has.
std::string changed_input(const io::ManifestPoint& point) {
  for (const auto& [file, content] : point.inputs)
    if (io::hash_of_content(file) != content)
      return file + ": is not as it was when the sweep was planned; restore it, or call '"
             + call_of("sweep") + "' with the sweep file and another --out";
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

io::Settings settings_of_point(const fs::path& file) {
  return io::Settings::from_text(io::read_kept_text(file), file.string(),
                                 scenarios::settings_tables());
}

io::Manifest manifest_in(const fs::path& sweep) {
  return as_input([&] { return io::read_manifest(sweep); });
}

std::string obstacle_at(const fs::path& point) {
  std::error_code error;
  if (fs::status(point / point_settings_name, error).type() != fs::file_type::none) return "";
  return io::system_failure(point, "cannot be reached", error.value()).what();
}

RunStanding standing_of(const fs::path& point) {
  return standing_of(point, io::read_run_record(point));
}

RunStanding standing_of(const fs::path& point, const io::RunRecord& record) {
  if (const std::string obstacle = obstacle_at(point); !obstacle.empty())
    return {.status = RunStatus::failed, .attempts = 0, .reason = obstacle};
  const auto with = [&](RunStatus status, const std::string& reason = "") {
    return RunStanding{.status = status, .attempts = record.attempts, .reason = reason};
  };
  if (is_done(point)) return with(RunStatus::done);  // 'riesel report' may hold the lock
  if (io::DirectoryLock::is_held(point)) return with(RunStatus::running);
  const std::string reason = reason_to_fail(point, record);
  if (!reason.empty()) return with(RunStatus::failed, reason);
  // A damaged result is made anew from the last checkpoint.
  const bool has_begun = record.attempts > 0 || fs::exists(point / io::summary_name);
  return with(has_begun ? RunStatus::interrupted : RunStatus::waiting);
}

fs::path summary_of(const fs::path& point) {
  const fs::path now = point / io::summary_name;
  return fs::exists(now) ? now : io::previous_generation(now);
}

bool is_among(const std::vector<std::string>& names, const std::string& point) {
  return names.empty() || std::ranges::find(names, point) != names.end();
}

void refresh(io::Manifest& manifest, const fs::path& sweep, const std::vector<std::string>& names) {
  std::map<std::string, RunStanding> standings;
  for (io::ManifestPoint& point : manifest.points) {
    if (!is_among(names, point.name)) continue;
    RunStanding& standing = standings[point.name];
    standing = standing_of(point_directory(sweep, point.name));
    if (standing.status == RunStatus::waiting) standing.reason = reason_to_wait(point, standings);
    point.status = to_string(standing.status);
    point.attempts = standing.attempts;
    point.reason = standing.reason;
  }
}

bool has_chains(const io::Manifest& manifest) {
  return std::ranges::any_of(manifest.points,
                             [](const auto& point) { return !point.parent.empty(); });
}

std::set<std::string> note_misplaced(io::Manifest& manifest, const fs::path& sweep,
                                     const std::vector<std::string>& names) {
  std::set<std::string> misplaced;
  for (io::ManifestPoint& point : manifest.points) {
    if (!is_among(names, point.name)) continue;
    const fs::path directory = point_directory(sweep, point.name);
    std::error_code out_of_reach;
    if (!is_done(directory)
        && !fs::exists(io::previous_generation(directory / io::summary_name), out_of_reach))
      continue;
    const std::string reason =
        misplacement(point, manifest.varied, directory / io::effective_settings_name);
    if (reason.empty()) continue;
    misplaced.insert(point.name);
    point.status = to_string(RunStatus::failed);
    point.reason = reason;
  }
  return misplaced;
}

std::string reason_not_to_start(const io::Manifest& manifest, const io::ManifestPoint& point,
                                const fs::path& sweep) {
  const fs::path directory = point_directory(sweep, point.name);
  if (can_resume(directory))
    return misplacement(point, manifest.varied, directory / io::effective_settings_name);
  const fs::path settings = directory / point_settings_name;
  // A run takes its settings from a pipe, too, and would wait for its writer.
  if (fs::exists(settings) && !fs::is_regular_file(settings))
    return settings.string() + ": is no regular file; remove it";
  const fs::path parent = point_directory(sweep, point.parent);
  if (!point.parent.empty() && !has_checkpoint(parent))
    return fmt::format("its neighbour {} has lost its checkpoint; restore that, or remove {} and "
                       "call '{}' with the sweep file and --retry-failed",
                       point.parent, parent.string(), call_of("sweep"));
  const std::string change = changed_input(point);
  return change.empty() ? misplacement(point, manifest.varied, settings) : change;
}

void reject_changed_inputs(const io::Manifest& manifest, const fs::path& sweep,
                           const std::vector<std::string>& names) {
  std::set<std::map<std::string, std::string>> unchanged;  // each is read once
  for (const io::ManifestPoint& point : manifest.points) {
    if (!is_among(names, point.name)) continue;
    const fs::path directory = point_directory(sweep, point.name);
    if (point.inputs.empty() || unchanged.contains(point.inputs)) continue;
    const RunStatus status = standing_of(directory).status;
    const bool is_open = status == RunStatus::waiting || status == RunStatus::interrupted;
    if (!is_open || can_resume(directory)) continue;
    const std::string change = changed_input(point);
    if (!change.empty()) throw UnusableInput(change);
    unchanged.insert(point.inputs);
  }
}

bool can_resume(const fs::path& point) {
  return fs::exists(point / io::run_file_name) && has_checkpoint(point);
}

bool can_begin(const fs::path& point) {
  return obstacle_at(point).empty() && (can_resume(point) || !fs::exists(point / io::summary_name));
}

void clear(const fs::path& point) {
  const io::DirectoryLock lock(point);
  if (fs::exists(point / io::summary_name) || can_resume(point)) return;
  const fs::path checkpoint = point / io::checkpoint_name, post_mortem = point / post_mortem_name;
  for (const fs::path& file :
       {checkpoint, io::previous_generation(checkpoint), post_mortem,
        io::previous_generation(post_mortem), point / io::run_file_name,
        point / io::effective_settings_name, point / io::trajectory_name,
        point / io::trajectory_index_name, io::previous_generation(point / io::summary_name)})
    fs::remove(file);
}

}  // namespace riesel::app
