#include "scenarios/scenario.hpp"

#include <algorithm>
#include <stdexcept>

namespace riesel::scenarios {

Scenario single_wall_grain();
Scenario wall_array();
Scenario bead_column();
Scenario periodic_tube();

const std::vector<Scenario>& all() {
  static const std::vector<Scenario> table = {
      single_wall_grain(),
      wall_array(),
      bead_column(),
      periodic_tube(),
  };
  return table;
}

const Scenario& named(const std::string& name) {
  const auto found =
      std::find_if(all().begin(), all().end(), [&](const Scenario& s) { return s.name == name; });
  if (found == all().end()) throw std::logic_error("no scenario '" + name + "' in the table");
  return *found;
}

const io::SettingsTables& settings_tables() {
  static const io::SettingsTables tables = [] {
    io::SettingsTables by_name;
    for (const Scenario& scenario : all()) {
      io::SettingsTable rows = io::common_settings();
      rows.insert(rows.end(), scenario.own_settings.begin(), scenario.own_settings.end());
      io::verify_table(rows);
      by_name.emplace(scenario.name, std::move(rows));
    }
    return by_name;
  }();
  return tables;
}

}  // namespace riesel::scenarios
