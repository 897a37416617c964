// The walls of the scenarios of many grains: corrugated or smooth, at rest or shaken.
#pragma once

#include "engine/state.hpp"
#include "io/settings.hpp"

#include <string>

namespace riesel::scenarios {

/// Cosine and sine of an angle, exactly 0 at a right angle.
struct Direction {
  double along, across;
};
Direction direction(double angle);

/// `wall.surface`, of corrugated walls `wall.grain_diameter` and `wall.spacing`, and how they
/// shake.
io::SettingsTable wall_settings();

/// The wall of these settings, at x = `line` (m). Rejects a spacing wider than the period, which
/// `key_of_length` sets.
WallLattice wall_at(double line, const io::Settings& settings, const Box& box,
                    const std::string& key_of_length);

/// Rejects a period that is too short for grains of diameter `largest` (m) or for the wall grains.
void reject_short_period(const io::Settings& settings, double largest, const State& empty,
                         const std::string& key_of_length);

/// Rejects a gap between two walls that is too narrow for grains of diameter `largest` (m).
void reject_narrow_gap(const io::Settings& settings, double largest, const State& empty,
                       const std::string& key_of_width);

/// Rejects wall grains so close together, `spacing` (m), that a grain can touch more of them than
/// the engine tells apart; `reach` (m) is the largest sum of the two radii.
void reject_crowded_wall(const io::Settings& settings, double reach, double spacing);

/// Rejects walls faster than largest_speed(), as grains, and shaking that time steps do not
/// resolve.
void reject_fast_walls(const io::Settings& settings, const State& state);

/// Rejects an interval of the output in step with walls that are shaken: its rows would see them in
/// a few phases only, and means over rows be off by what grains do in the others.
void reject_rows_in_step(const io::Settings& settings, const State& state);

}  // namespace riesel::scenarios
