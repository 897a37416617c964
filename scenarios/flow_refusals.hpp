// Refuses, before they begin, flows whose numbers would leave the range of the fixed-point state or
// of sums. The errors name the setting to blame and what to choose instead. All throw
// io::SettingsError.
#pragma once

#include "engine/state.hpp"
#include "io/settings.hpp"

#include <cstddef>
#include <vector>

namespace riesel::scenarios {

/// Rejects gravity so strong that grains may get too fast between two looks at the run, or so weak
/// that its rounding to whole quanta per step shows. The time step of `state` must be set; `grains`
/// is the number that it will have.
void reject_unfit_gravity(const io::Settings& settings, std::size_t grains, const State& state);

/// Rejects grains that move or turn too fast for the box and the time step of `state`. They are not
/// in it yet, as it might not be able to hold them.
void reject_fast_motion(const io::Settings& settings, const std::vector<Grain>& grains,
                        const State& state);

/// Rejects grains of `state` whose total mass or energy would overflow the sums.
void reject_heavy_grains(const io::Settings& settings, const State& state);

}  // namespace riesel::scenarios
