// A scenario turns settings into a problem for the engine. One scenario is one .cpp file, with the
// .yaml beside it that reproduces what a paper has; all of them stand in one table.
//
// To add one: write its .cpp with a function that returns its Scenario, declare that function in
// table.cpp and add it to the table there. A program of somebody else adds its own with add(), and
// contact laws, too (docs/extending.md).
#pragma once

#include "engine/bead_column.hpp"
#include "engine/contact_law.hpp"
#include "engine/impact.hpp"
#include "engine/rigid_column.hpp"
#include "engine/state.hpp"
#include "io/settings.hpp"

#include <string>
#include <variant>
#include <vector>

namespace riesel::scenarios {

/// Many grains along one wall or two, to be stepped for a while and averaged over. The table of
/// such a scenario has common_flow_settings() and the mean `grains.diameter` and `grains.mass`.
struct Flow {
  State state;
  ContactModel model;
};

/// Single grains thrown at a wall; each point of the curve is the mean over its starts.
struct ImpactCurve {
  struct Point {
    double v_x, v_y;  ///< m/s
    std::size_t first_impact, impacts;
  };
  ImpactSetup setup;
  std::vector<Impact> impacts;
  std::vector<Point> points;
};

/// A column of beads dropped on a plate, once for each gap between the beads.
struct ColumnCurve {
  ColumnSetup setup;
  RigidColumn rigid;               ///< what it tends to for wide gaps
  std::vector<double> gap_ratios;  ///< gap over velocity times collision time

  double gap(double ratio) const { return ratio * setup.velocity * setup.collision_time; }  ///< m
};

using Problem = std::variant<Flow, ImpactCurve, ColumnCurve>;

struct Scenario {
  std::string name;
  std::string summary;                      ///< one sentence, with what it reproduces
  io::SettingsTable own_settings;           ///< besides the common ones
  Problem (*prepare)(const io::Settings&);  ///< throws SettingsError for what cannot be
};

/// What the command asks of every flow: `run.duration`, `run.until`, `limits`, `output`.
io::SettingsTable common_flow_settings();

/// A contact law from outside of the library, as a value of the setting `contact.law`.
struct Law {
  std::string name;
  io::SettingsTable own_settings;  ///< keys of `contact`; they count with this law only
  NormalLaw (*make)(const io::Settings&);
};

/// These are for the beginning of a program, before settings are read. Throw std::logic_error for a
/// name that is taken, or if it is too late.
void add(Scenario scenario);
void add(Law law);

/// The law of this name that was added, or nothing.
const Law* added_law(const std::string& name);

/// All scenarios, in the order in which they are listed to the user.
const std::vector<Scenario>& all();

/// The scenario with this name, which must exist.
const Scenario& named(const std::string& name);

/// The settings of each scenario, common rows included: what io::Settings wants.
const io::SettingsTables& settings_tables();

/// The contact model of a problem: fixed by the settings alone, so that a resumed run finds it
/// again.
ContactModel contact_model(const io::Settings& settings);

}  // namespace riesel::scenarios
