#include "app/prolongation.hpp"

#include "app/commands.hpp"
#include "app/resumed_settings.hpp"
#include "io/checkpoint.hpp"
#include "io/directory_lock.hpp"
#include "io/file_error.hpp"
#include "io/run_record.hpp"
#include "io/settings.hpp"
#include "io/settings_given.hpp"
#include "io/settings_table.hpp"
#include "io/settings_text.hpp"
#include "io/summary.hpp"
#include "io/summary_reader.hpp"
#include "scenarios/scenario.hpp"

#include <algorithm>
#include <optional>
#include <variant>

namespace riesel::app {

namespace fs = std::filesystem;

namespace {

void reject_threads(const std::vector<std::string>& overrides) {
  for (const io::YamlEntry& setting : io::parse_overrides(overrides))
    if (setting.key == "run.threads")
      throw io::SettingsError(setting.key_place, setting.key, "cannot be set for a whole sweep",
                              "leave it out: the runs share the cores");
}

void reject_continuation(const io::Manifest& manifest, const fs::path& sweep) {
  if (has_chains(manifest))
    throw UnusableInput(sweep.string()
                        + ": its runs start from each other's ends and cannot go on; make a sweep "
                          "with a longer run.duration");
}

void reject_without_length(const io::Settings& settings, const fs::path& sweep) {
  const std::string& scenario = settings.scenario();
  if (!io::has_key(scenarios::settings_tables().at(scenario), "run.duration"))
    throw UnusableInput(sweep.string() + ": runs of the scenario " + scenario
                        + " have no length in time; there is nothing to go on with");
}

/// The summary of a flow that is done; nothing if it is not, or if its summary cannot be read, as
/// one written by another version.
std::optional<io::FlowSummary> result_of(const fs::path& point) {
  try {
    const io::Summary any = io::read_summary(point / io::summary_name);
    if (const auto* flow = std::get_if<io::FlowSummary>(&any)) return *flow;
  } catch (const io::FileError&) {
  }
  return {};
}

/// The length that the run was to have when it ended; nothing if its settings cannot be read.
std::optional<scenarios::RunLength> length_of(const fs::path& point) {
  try {
    return scenarios::run_length(settings_of_point(point / io::effective_settings_name));
  } catch (const io::SettingsError&) {
    return {};
  }
}

/// The checkpoint from which the run of a point can go on. Nothing if there is none, or if it is
/// damaged, which the run itself will tell.
std::optional<io::FoundCheckpoint> checkpoint_of(const fs::path& point) {
  if (!can_resume(point)) return {};
  try {
    return io::find_checkpoint(point);
  } catch (const io::FileError&) {
    return {};
  }
}

bool has_reached(const scenarios::RunLength& wanted, const fs::path& point,
                 const io::FlowSummary& summary) {
  const double step = summary.time / static_cast<double>(summary.run.steps);
  if (wanted.at_most < summary.time + 0.5 * step) return true;  // runs end with a whole step
  if (!wanted.relative_error || summary.ended_by != io::EndedBy::precision) return false;
  const auto had = length_of(point);
  return had && had->relative_error && *had->relative_error <= *wanted.relative_error;
}

}  // namespace

Prolongation::Prolongation(const io::Manifest& manifest, const fs::path& sweep,
                           const std::vector<std::string>& names,
                           const std::vector<std::string>& overrides) {
  if (overrides.empty()) return;
  reject_overrides_of_the_physics(overrides);
  reject_threads(overrides);
  reject_continuation(manifest, sweep);
  for (const io::ManifestPoint& point : manifest.points) {
    if (!is_among(names, point.name)) continue;
    const fs::path directory = point_directory(sweep, point.name);
    if (!obstacle_at(directory).empty()) continue;
    const io::Settings planned = settings_of_point(directory / point_settings_name);
    reject_without_length(planned, sweep);
    goals_[point.name] = goal_for(directory, planned, overrides);
  }
}

Prolongation::Goal Prolongation::goal_for(const fs::path& point, const io::Settings& planned,
                                          const std::vector<std::string>& overrides) {
  const double planned_length = scenarios::run_length(planned).at_most;
  if (const auto found = checkpoint_of(point)) {  // its settings may have changed since the plan
    const io::Checkpoint& checkpoint = found->checkpoint;
    const io::Settings settings =
        resumed_settings(checkpoint.settings, found->path.string(), overrides);
    return {.planned = planned_length,
            .wanted = resumed_length(settings, checkpoint.state),
            .changes = overrides};
  }
  const fs::path file = point / point_settings_name;
  return {.planned = planned_length,
          .wanted = scenarios::run_length(
              resumed_settings(io::read_kept_text(file), file.string(), overrides)),
          .changes = changes_to(planned, overrides)};
}

const Prolongation::Goal* Prolongation::goal_of(const fs::path& point) const {
  const auto found = goals_.find(point.filename().string());
  return found == goals_.end() ? nullptr : &found->second;
}

RunStanding Prolongation::standing_of(const fs::path& point) const {
  const Goal* goal = goal_of(point);
  io::RunRecord record = io::read_run_record(point);
  const bool tried_otherwise =
      goal != nullptr && !record.changes.empty() && record.changes != overrides_for(point);
  if (tried_otherwise) record.failure.clear();
  RunStanding standing = app::standing_of(point, record);
  if (standing.status != RunStatus::done || goal == nullptr) return standing;
  const auto result = result_of(point);
  if (!result || has_reached(goal->wanted, point, *result)) return standing;
  if (io::DirectoryLock::is_held(point)) {  // it is going on already, or its report is being made
    standing.status = RunStatus::running;
    return standing;
  }
  standing.reason = record.failure;
  if (!can_resume(point))
    standing.reason = "has no checkpoint to go on from; remove its directory to begin anew";
  standing.status = standing.reason.empty() ? RunStatus::interrupted : RunStatus::failed;
  return standing;
}

void Prolongation::look_ahead(io::Manifest& manifest, const fs::path& sweep) const {
  refresh(manifest, sweep);
  for (io::ManifestPoint& point : manifest.points) {
    if (!goals_.contains(point.name)) continue;
    const fs::path directory = point_directory(sweep, point.name);
    const RunStanding standing = standing_of(directory);
    point.status = to_string(standing.status);
    point.reason = standing.reason;
    point.expected_seconds *= part_left(directory);
  }
  note_misplaced(manifest, sweep);
}

std::vector<std::string> Prolongation::overrides_for(const fs::path& point) const {
  const Goal* goal = goal_of(point);
  // A shorter goal does not cut short a run that has not reached its plan.
  const bool goes_on =
      goal != nullptr && (goal->wanted.at_most >= goal->planned || result_of(point));
  return goes_on ? goal->changes : std::vector<std::string>();
}

double Prolongation::part_left(const fs::path& point) const {
  const Goal* goal = goal_of(point);
  if (goal == nullptr) return 1.0;
  const auto result = result_of(point);
  const double length = std::max(goal->wanted.at_most, goal->planned);
  return std::max(0.0, length - (result ? result->time : 0.0)) / goal->planned;
}

}  // namespace riesel::app
