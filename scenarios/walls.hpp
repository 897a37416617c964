// The walls of the scenarios of many grains: corrugated or smooth, at rest or shaken.
#pragma once

#include "engine/state.hpp"
#include "io/settings.hpp"

#include <string>

namespace riesel::scenarios {

/// Cosine (along) and sine (across) of an angle (rad); the cosine is exactly 0 at a right angle.
struct Direction {
  double along, across;
};
Direction direction(double angle);

/// `wall.surface`; for corrugated walls `wall.grain_diameter` and `wall.spacing`; and how walls
/// shake.
io::SettingsTable wall_settings();

/// The wall of these settings, at x = `line` (m). Rejects shaking that is half given or too wide,
/// and a spacing wider than the period, which `key_of_length` sets.
WallLattice wall_at(double line, const io::Settings& settings, const Box& box,
                    const std::string& key_of_length);

/// The largest grain of a flow.
struct LargestGrain {
  double diameter;     ///< m
  const char* set_by;  ///< the key that sets it: to blame if it does not fit
};

/// Rejects a period that is too short for the grains or for the wall grains.
void reject_short_period(const io::Settings& settings, const LargestGrain& largest,
                         const State& empty, const std::string& key_of_length);

/// Rejects a space between two walls that is too short, as above, or too narrow for the grains.
/// `section` has the keys `length` and `width`.
void reject_small_space(const io::Settings& settings, const LargestGrain& largest,
                        const State& empty, const std::string& section);

/// Rejects wall grains whose `spacing` (m) is so small that a grain can touch more of them than the
/// engine tells apart; `reach` (m) is the largest sum of the two radii.
void reject_crowded_wall(const io::Settings& settings, double reach, double spacing);

/// Rejects walls faster than largest_speed(), the limit for grains, and shaking that the time steps
/// do not resolve.
void reject_fast_walls(const io::Settings& settings, const State& state);

/// Rejects an output.interval in step with walls that are shaken, or that pass each other: rows
/// would see the walls in a few phases only, and means over rows would miss what grains do in the
/// others. To be called again when a run is given another length.
void reject_rows_in_step(const io::Settings& settings, const State& state);

}  // namespace riesel::scenarios
