// Flows that a state cannot hold, or its steps not follow: refused before they begin, with the
// setting that is to blame and what to choose instead. All throw SettingsError.
#pragma once

#include "engine/state.hpp"
#include "io/settings.hpp"

#include <cstddef>
#include <vector>

namespace riesel::scenarios {

/// Gravity under which grains get too fast from one look to the next, or which the velocities,
/// whole quanta per step, round off. The time step of `state` is set; it will have so many grains.
void reject_unfit_gravity(const io::Settings& settings, std::size_t grains, const State& state);

/// Too fast or turning too fast for the box and the time step of `state`: grains that are not in it
/// yet, as it may not hold them.
void reject_fast_motion(const io::Settings& settings, const std::vector<Grain>& grains,
                        const State& state);

/// Grains of `state` that together have more mass or energy than sums hold.
void reject_heavy_grains(const io::Settings& settings, const State& state);

}  // namespace riesel::scenarios
