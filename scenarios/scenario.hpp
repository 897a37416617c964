// A scenario turns settings into a problem for the engine. Each is one .cpp file, with a .yaml
// beside it that reproduces the results of a paper; all of them are listed in one table.
//
// To add one: write its .cpp with a function that returns its Scenario, declare that function in
// table.cpp and add it to the table there. Programs outside this repository add scenarios and
// contact laws of their own with add() (docs/extending.md).
#pragma once

#include "engine/bead_column.hpp"
#include "engine/contact_law.hpp"
#include "engine/impact.hpp"
#include "engine/rigid_column.hpp"
#include "engine/state.hpp"
#include "io/settings.hpp"

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace riesel::scenarios {

/// Many grains along one wall or between two, to be stepped for a while and averaged over. The
/// settings of such a scenario must include common_flow_settings() and `grains.mass`, to which
/// `contact.restitution` refers.
struct Flow {
  /// Of the last state of the run that it continues, what its own start must fit.
  struct Earlier {
    std::string identity;               ///< of the run and its state, for people
    std::vector<double> swings_across;  ///< m, amplitudes along x with which the walls are shaken
    double elastic_energy;              ///< J, of the overlaps under its contact law
    double random_energy;               ///< J, of the motion relative to the mean velocity
  };
  State state;
  ContactModel model;
  std::optional<Earlier> continues = {};
};

/// Single grains thrown at a wall; each point of the curve is the mean over its impacts, which have
/// different starting places.
struct ImpactCurve {
  struct Point {
    double v_x, v_y;                    ///< m/s
    std::size_t first_impact, impacts;  ///< index and number of its impacts in the vector below
  };
  ImpactSetup setup;
  std::vector<Impact> impacts;
  std::vector<Point> points;
};

/// A column of beads dropped on a plate, once for each gap between the beads.
struct ColumnCurve {
  ColumnSetup setup;
  RigidColumn rigid;               ///< the limit of wide gaps
  std::vector<double> gap_ratios;  ///< gap over velocity times collision time

  double gap(double ratio) const { return ratio * setup.velocity * setup.collision_time; }  ///< m
};

using Problem = std::variant<Flow, ImpactCurve, ColumnCurve>;

struct Scenario {
  std::string name;
  std::string summary;             ///< one sentence, which says what it reproduces
  io::SettingsTable own_settings;  ///< besides the common ones
  /// Throws io::SettingsError for unusable settings. Does not look at Flow::continues.
  Problem (*prepare)(const io::Settings&);
};

/// The settings that every flow must have: `run.duration`, `run.until`, `limits`, `output`.
io::SettingsTable common_flow_settings();

/// A contact law from outside of the library, as a value of the setting `contact.law`.
struct Law {
  std::string name;
  io::SettingsTable own_settings;  ///< keys of `contact`, in effect with this law only
  NormalLaw (*make)(const io::Settings&);
};

/// To be called at the start of a program, before settings_tables() is. Throw std::logic_error for
/// a name that is taken, without the function, or if it is too late.
void add(Scenario scenario);
void add(Law law);

/// The law of this name that was added with add(), or nullptr.
const Law* added_law(const std::string& name);

/// All scenarios, in the order in which they are listed to the user.
const std::vector<Scenario>& all();

/// The scenario with this name. Throws std::logic_error if there is none.
const Scenario& named(const std::string& name);

/// What the settings ask for. Throws io::SettingsError for unusable settings, and for a flow that
/// would be thrown apart as it does not fit the one that it continues.
Problem problem_of(const io::Settings& settings);

/// For each scenario the table of all its settings, common rows included, as io::Settings takes it.
const io::SettingsTables& settings_tables();

/// The contact model of a problem. It depends on the settings alone, so that a resumed run gets the
/// same.
ContactModel contact_model(const io::Settings& settings);

}  // namespace riesel::scenarios
