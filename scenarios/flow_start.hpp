// What the scenarios of many grains have in common: how grains begin, and the way from grains at
// their places to a flow.
#pragma once

#include "scenarios/scenario.hpp"
#include "scenarios/size_distribution.hpp"

#include <initializer_list>
#include <string>
#include <vector>

namespace riesel::scenarios {

/// The settings of a flow: how its grains begin, on which the others depend; these rows; and the
/// common ones.
io::SettingsTable flow_table(std::initializer_list<io::SettingsTable> rows);
/// `start.axial_velocity`, by default `axial`, and `start.random_velocity`, of a fresh start.
io::SettingsTable start_velocity_settings(const std::string& axial,
                                          const std::string& random = "0.5 m/s");
/// `grains.area_fraction` of what is between two walls.
io::SettingsTable area_fraction_settings();
/// Grains up to this fraction, packed.
std::vector<Grain> fill_between_walls(const io::Settings& settings, const SizeDistribution& sizes,
                                      const State& empty);

/// What is to be known of the room that the grains get.
struct Room {
  State empty;  ///< without grains; whether they will rotate is filled in
  /// Rejects room that is too small for grains of this diameter (m).
  void (*reject_too_small)(const io::Settings&, double largest, const State& empty);
  /// Grains at their places, of a fresh start; velocities are set then.
  std::vector<Grain> (*place_grains)(const io::Settings&, const SizeDistribution&,
                                     const State& empty);
};

/// Fills the room as `start.kind` says. Throws SettingsError for what cannot be.
Flow start_flow(const io::Settings& settings, Room room);

/// m, of as many grains as bring their area closest to `wanted` (m^2). Rejects sizes so small that
/// these would be more grains than can be counted.
std::vector<double> radii_of_area(const io::Settings& settings, const SizeDistribution& sizes,
                                  double wanted);

/// Grains of these radii (m) at places of `pack()`, with masses in proportion to their area.
/// Nothing if they do not fit.
std::vector<Grain> packed_grains(const io::Settings& settings, const std::vector<double>& radii,
                                 const State& empty);

}  // namespace riesel::scenarios
