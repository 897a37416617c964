#include "scenarios/continued_start.hpp"
#include "scenarios/scenario.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace riesel::scenarios {

Scenario single_wall_grain();
Scenario wall_array();
Scenario bead_column();
Scenario periodic_tube();
Scenario inclined_chute();
Scenario shear_cell();

namespace {

constexpr auto law_key = "contact.law";

struct Registry {
  std::vector<Scenario> scenarios = {
      single_wall_grain(), wall_array(),     bead_column(),
      periodic_tube(),     inclined_chute(), shear_cell(),
  };
  std::vector<Law> laws;
  bool in_use = false;  // the tables of settings have been made from it
};

Registry& registry() {
  static Registry the_only_one;
  return the_only_one;
}

template <class Entry>
const Entry* find(const std::vector<Entry>& entries, const std::string& name) {
  const auto found = std::ranges::find(entries, name, &Entry::name);
  return found == entries.end() ? nullptr : &*found;
}

template <class Entry>
void add_to(std::vector<Entry>& entries, Entry entry) {
  if (registry().in_use) throw std::logic_error("'" + entry.name + "' is added too late");
  if (find(entries, entry.name) != nullptr)
    throw std::logic_error("'" + entry.name + "' is added twice");
  entries.push_back(std::move(entry));
}

bool is_built_in_law(const std::string& name) {
  const io::SettingsTable table = io::common_settings();
  const auto row = std::ranges::find(table, law_key, &io::Setting::key);
  return std::ranges::find(row->choices, name) != row->choices.end();
}

/// Makes the law one more choice, with its rows behind those of the other laws. Its collision time
/// has no closed form and is taken at contact.impact_speed, which therefore applies to it, too.
void add_rows(const Law& law, io::SettingsTable& table) {
  auto place = table.begin();
  for (auto row = table.begin(); row != table.end(); ++row) {
    if (row->key == law_key) row->choices.push_back(law.name);
    if (row->key == "contact.impact_speed") row->only_when->values.push_back(law.name);
    if (row->only_when && row->only_when->key == law_key) place = row + 1;
  }
  io::SettingsTable rows = law.own_settings;
  for (io::Setting& row : rows) row.only_when = io::When{law_key, {law.name}};
  table.insert(place, rows.begin(), rows.end());
}

}  // namespace

const std::vector<Scenario>& all() { return registry().scenarios; }

const Scenario& named(const std::string& name) {
  const Scenario* found = find(all(), name);
  if (found == nullptr) throw std::logic_error("no scenario '" + name + "' in the table");
  return *found;
}

Problem problem_of(const io::Settings& settings) {
  Problem problem = named(settings.scenario()).prepare(settings);
  if (const auto* flow = std::get_if<Flow>(&problem); flow != nullptr && flow->continues) {
    reject_other_swing_across(settings, flow->continues->swings_across, flow->state);
    reject_released_energy(settings, *flow->continues, flow->state);
  }
  return problem;
}

void add(Scenario scenario) {
  if (scenario.prepare == nullptr)
    throw std::logic_error("'" + scenario.name + "' lacks its function prepare");
  add_to(registry().scenarios, std::move(scenario));
}

void add(Law law) {
  if (is_built_in_law(law.name))
    throw std::logic_error("'" + law.name + "' is a law of riesel already");
  if (law.make == nullptr) throw std::logic_error("'" + law.name + "' lacks its function make");
  add_to(registry().laws, std::move(law));
}

const Law* added_law(const std::string& name) { return find(registry().laws, name); }

const io::SettingsTables& settings_tables() {
  static const io::SettingsTables tables = [] {
    registry().in_use = true;
    io::SettingsTables by_name;
    for (const Scenario& scenario : all()) {
      io::SettingsTable rows = io::common_settings();
      for (const Law& law : registry().laws) add_rows(law, rows);
      rows.insert(rows.end(), scenario.own_settings.begin(), scenario.own_settings.end());
      io::verify_table(rows);
      by_name.emplace(scenario.name, std::move(rows));
    }
    return by_name;
  }();
  return tables;
}

}  // namespace riesel::scenarios
