// What the scenarios of many grains have in common: how grains start, and how a flow is made from
// grains at their places.
#pragma once

#include "scenarios/scenario.hpp"
#include "scenarios/size_distribution.hpp"
#include "scenarios/walls.hpp"

#include <initializer_list>
#include <string>
#include <vector>

namespace riesel::scenarios {

/// The settings of a flow: those of its start, on which others depend, so that they come first;
/// these rows; and the common ones.
io::SettingsTable flow_table(std::initializer_list<io::SettingsTable> rows);
/// `start.axial_velocity` and `start.random_velocity` of a fresh start, with these defaults.
io::SettingsTable start_velocity_settings(const std::string& axial,
                                          const std::string& random = "0.5 m/s");
/// `grains.area_fraction`, of the area between two walls.
io::SettingsTable area_fraction_settings();
/// Grains that fill the space between two walls up to this fraction; fits Room::place_grains.
/// Throws io::SettingsError if they cannot be packed.
std::vector<Grain> fill_between_walls(const io::Settings& settings, const SizeDistribution& sizes,
                                      const State& empty);

/// The room that a scenario has for its grains.
struct Room {
  State empty;  ///< without grains; start_flow() sets whether they rotate
  /// Rejects room that is too small for the largest grain.
  void (*reject_too_small)(const io::Settings&, const LargestGrain&, const State& empty);
  /// Grains at their places for a fresh start; start_flow() sets their velocities.
  std::vector<Grain> (*place_grains)(const io::Settings&, const SizeDistribution&,
                                     const State& empty);
};

/// Fills the room as `start.kind` says. Throws io::SettingsError for settings that cannot be met.
Flow start_flow(const io::Settings& settings, Room room);

/// The radii (m) of as many grains as bring their total area closest to `wanted` (m^2); at least
/// one. Rejects sizes so small that the engine cannot hold that many grains.
std::vector<double> radii_of_area(const io::Settings& settings, const SizeDistribution& sizes,
                                  double wanted);

/// Grains of these radii (m) at places from pack(), with masses in proportion to their area. Empty
/// if they do not fit.
std::vector<Grain> packed_grains(const io::Settings& settings, const std::vector<double>& radii,
                                 const State& empty);

}  // namespace riesel::scenarios
