#include "app/prolongation.hpp"

#include "app/commands.hpp"
#include "app/resumed_settings.hpp"
#include "io/run_file.hpp"
#include "io/settings_given.hpp"
#include "io/summary_reader.hpp"
#include "scenarios/run_length.hpp"
#include "scenarios/scenario.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

namespace riesel::app {

namespace fs = std::filesystem;

namespace {

/// Of a run that has begun, those that it goes by; else those that it will begin with.
fs::path settings_of(const fs::path& point) {
  const fs::path effective = point / io::effective_settings_name;
  return fs::exists(effective) ? effective : point / point_settings_name;
}

/// s, simulated, of a run that has a result.
std::optional<double> time_done(const fs::path& point) {
  const fs::path summary = point / io::summary_name;
  if (!fs::exists(summary)) return {};
  const io::Summary any = io::read_summary(summary);
  const auto* flow = std::get_if<io::FlowSummary>(&any);
  return flow != nullptr ? std::optional(flow->time) : std::nullopt;
}

/// Whether "key=" takes out a setting that is not there, as the run has gone on like this already.
bool is_done_already(const std::string& override, const io::Settings& from) {
  const io::YamlEntry setting = io::parse_overrides({override}).front();
  return setting.value.shape == io::YamlNode::Shape::null
         && io::has_key(scenarios::settings_tables().at(from.scenario()), setting.key)
         && !from.has(setting.key);
}

void reject_threads(const std::vector<std::string>& overrides) {
  for (const io::YamlEntry& setting : io::parse_overrides(overrides))
    if (setting.key == "run.threads")
      throw io::SettingsError(setting.key_place, setting.key, "cannot be set for a whole sweep",
                              "choose the number of runs side by side with --jobs");
}

void reject_continuation(const io::Manifest& manifest, const fs::path& sweep) {
  if (std::ranges::any_of(manifest.points, [](auto& point) { return !point.parent.empty(); }))
    throw UnusableInput(sweep.string()
                        + ": its runs start from each other's ends and cannot go on; make a sweep "
                          "with a longer run.duration");
}

struct Change {
  io::Settings from, to;
  std::vector<std::string> overrides;  // that lead from one to the other
};

Change change_of(const fs::path& point, const std::vector<std::string>& overrides) {
  const fs::path file = settings_of(point);
  const io::SettingsTables& tables = scenarios::settings_tables();
  io::Settings from = io::Settings::from_file(file, tables);
  std::vector<std::string> leading;
  std::ranges::copy_if(overrides, std::back_inserter(leading),
                       [&](auto& each) { return !is_done_already(each, from); });
  io::Settings to = io::Settings::from_file(file, tables, leading);
  return {.from = std::move(from), .to = std::move(to), .overrides = std::move(leading)};
}

}  // namespace

Prolongation::Prolongation(const io::Manifest& manifest, const fs::path& sweep,
                           std::vector<std::string> overrides)
    : overrides_(std::move(overrides)) {
  if (overrides_.empty()) return;
  reject_overrides_of_the_physics(overrides_);
  reject_threads(overrides_);
  reject_continuation(manifest, sweep);
  for (const io::ManifestPoint& point : manifest.points) {
    const io::Settings settings = change_of(point_directory(sweep, point.name), overrides_).to;
    const std::string& scenario = settings.scenario();
    if (!io::has_key(scenarios::settings_tables().at(scenario), "run.duration"))
      throw UnusableInput(sweep.string() + ": runs of the scenario " + scenario
                          + " have no length in time; there is nothing to go on with");
    scenarios::run_length(settings);
  }
}

Prolongation::Way Prolongation::way_of(const fs::path& point) const {
  constexpr double all = 1.0;
  if (overrides_.empty()) return {.overrides = {}, .is_new = false, .part = all};
  Change change = change_of(point, overrides_);
  const double planned = scenarios::run_length(change.from).at_most;
  const double wanted = scenarios::run_length(change.to).at_most;
  const std::optional<double> done = time_done(point);
  if (wanted < done.value_or(planned)) return {.overrides = {}, .is_new = false, .part = all};
  return {.overrides = std::move(change.overrides),
          .is_new = change.to.effective_yaml() != change.from.effective_yaml(),
          .part = (wanted - done.value_or(0.0)) / planned};
}

RunStanding Prolongation::standing_of(const fs::path& point) const {
  RunStanding standing = app::standing_of(point);
  if (standing.status == RunStatus::done && way_of(point).is_new)
    standing.status = RunStatus::interrupted;
  return standing;
}

void Prolongation::refresh(io::Manifest& manifest, const fs::path& sweep) const {
  app::refresh(manifest, sweep);
  if (overrides_.empty()) return;
  for (io::ManifestPoint& point : manifest.points) {
    const fs::path directory = point_directory(sweep, point.name);
    point.status = to_string(standing_of(directory).status);
    point.expected_seconds *= way_of(directory).part;
  }
}

}  // namespace riesel::app
