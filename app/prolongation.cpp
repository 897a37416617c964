#include "app/prolongation.hpp"

#include "app/commands.hpp"
#include "app/resumed_settings.hpp"
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
#include <utility>
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

io::Settings kept_settings(const fs::path& file) {
  return io::Settings::from_text(io::read_kept_text(file), file.string(),
                                 scenarios::settings_tables());
}

/// The length that the run was to have when it ended; nothing if its settings cannot be read.
std::optional<scenarios::RunLength> length_of(const fs::path& point) {
  try {
    return scenarios::run_length(kept_settings(point / io::effective_settings_name));
  } catch (const io::SettingsError&) {
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
                           std::vector<std::string> overrides)
    : overrides_(std::move(overrides)) {
  if (overrides_.empty()) return;
  reject_overrides_of_the_physics(overrides_);
  reject_threads(overrides_);
  reject_continuation(manifest, sweep);
  for (const io::ManifestPoint& point : manifest.points) {
    if (!names.empty() && std::ranges::find(names, point.name) == names.end()) continue;
    const fs::path file = point_directory(sweep, point.name) / point_settings_name;
    const io::Settings planned = kept_settings(file);
    reject_without_length(planned, sweep);
    goals_[point.name] = {.planned = scenarios::run_length(planned).at_most,
                          .wanted = scenarios::run_length(resumed_settings(
                              io::read_kept_text(file), file.string(), overrides_))};
  }
}

const Prolongation::Goal* Prolongation::goal_of(const fs::path& point) const {
  const auto found = goals_.find(point.filename().string());
  return found == goals_.end() ? nullptr : &found->second;
}

RunStanding Prolongation::standing_of(const fs::path& point) const {
  RunStanding standing = app::standing_of(point);
  const Goal* goal = goal_of(point);
  if (standing.status != RunStatus::done || goal == nullptr) return standing;
  const auto result = result_of(point);
  if (!result || has_reached(goal->wanted, point, *result)) return standing;
  standing.reason = io::read_run_record(point).failure;
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
}

std::vector<std::string> Prolongation::overrides_for(const fs::path& point) const {
  const Goal* goal = goal_of(point);
  // A shorter goal does not cut short a run that has not reached its plan.
  const bool goes_on =
      goal != nullptr && (goal->wanted.at_most >= goal->planned || result_of(point));
  return goes_on ? overrides_ : std::vector<std::string>();
}

double Prolongation::part_left(const fs::path& point) const {
  const Goal* goal = goal_of(point);
  if (goal == nullptr) return 1.0;
  const auto result = result_of(point);
  const double length = std::max(goal->wanted.at_most, goal->planned);
  return std::max(0.0, length - (result ? result->time : 0.0)) / goal->planned;
}

}  // namespace riesel::app
