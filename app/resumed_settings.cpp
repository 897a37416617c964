#include "app/resumed_settings.hpp"

#include "io/settings_error.hpp"
#include "io/settings_given.hpp"
#include "io/settings_names.hpp"
#include "io/settings_table.hpp"
#include "scenarios/scenario.hpp"
#include "scenarios/walls.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace riesel::app {

namespace {

/// What may change when a run is resumed: keys, and sections of which all keys may.
const std::vector<std::string>& changeable() {
  static const std::vector<std::string> names = {"run.duration", "run.until",
                                                 "run.threads",  "run.stepping",
                                                 "limits",       "output.checkpoint_interval"};
  return names;
}

/// Whether any scenario has it. If none has, the error comes when the settings are read.
bool is_known(const std::string& key) {
  return std::ranges::any_of(scenarios::settings_tables(), [&](const auto& table) {
    return io::has_key(table.second, key) || io::has_section(table.second, key);
  });
}

/// Whether the override is "key=" for a known key that has no value.
bool takes_out_nothing(const std::string& override, const io::Settings& from) {
  const io::YamlEntry setting = io::parse_overrides({override}).front();
  return setting.value.shape == io::YamlNode::Shape::null
         && io::has_key(scenarios::settings_tables().at(from.scenario()), setting.key)
         && !from.has(setting.key);
}

}  // namespace

bool may_change(const std::string& key) {
  return std::ranges::any_of(changeable(), [&](const std::string& name) {
    return name == key || name == io::section_of(key);
  });
}

void reject_overrides_of_the_physics(const std::vector<std::string>& overrides) {
  for (const io::YamlEntry& setting : io::parse_overrides(overrides)) {
    if (is_known(setting.key) && !may_change(setting.key))
      throw io::SettingsError(setting.key_place, setting.key, "cannot change when a run is resumed",
                              fmt::format("only {} can; for anything else start a new run",
                                          io::enumerate(changeable())));
  }
}

std::vector<std::string> changes_to(const io::Settings& before,
                                    std::vector<std::string> overrides) {
  std::erase_if(overrides,
                [&](const std::string& each) { return takes_out_nothing(each, before); });
  return overrides;
}

io::Settings resumed_settings(const std::string& checkpoint, const std::string& source,
                              const std::vector<std::string>& overrides) {
  const io::SettingsTables& tables = scenarios::settings_tables();
  const io::Settings before = io::Settings::from_text(checkpoint, source, tables);
  return io::Settings::from_text(checkpoint, source, tables, changes_to(before, overrides));
}

scenarios::RunLength resumed_length(const io::Settings& settings, const State& state) {
  scenarios::RunLength length = scenarios::run_length(settings);
  scenarios::reject_too_many_steps(settings, length, state.time_step);
  scenarios::reject_rows_in_step(settings, state);
  return length;
}

}  // namespace riesel::app
