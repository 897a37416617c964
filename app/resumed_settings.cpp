#include "app/resumed_settings.hpp"

#include "io/settings_error.hpp"
#include "io/settings_given.hpp"
#include "io/settings_table.hpp"

#include <set>

namespace riesel::app {

namespace {

/// Keys and sections.
bool may_change(const std::string& key) {
  static const std::set<std::string> names = {"run.duration", "run.until",
                                              "run.threads",  "run.stepping",
                                              "limits",       "output.checkpoint_interval"};
  return names.contains(key) || names.contains(io::section_of(key));
}

}  // namespace

void reject_overrides_of_the_physics(const std::vector<std::string>& overrides) {
  for (const io::YamlEntry& setting : io::parse_overrides(overrides)) {
    if (!may_change(setting.key))
      throw io::SettingsError(setting.key_place, setting.key, "cannot change when a run is resumed",
                              "only run.duration, run.until, run.threads, run.stepping, limits and "
                              "output.checkpoint_interval can; for anything else start a new run");
  }
}

}  // namespace riesel::app
