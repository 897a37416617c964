// How the kicks of contacts reach the velocities in plain stepping.
//
// In a State the velocity is that of the last displacement, and a kick waits for the next step to
// take it up. While plain stepping goes on it is added to both the kick and the velocity of a grain
// at once: who is kicked is looked at but once in a step.
#pragma once

#include "engine/candidates.hpp"
#include "engine/slice.hpp"
#include "engine/state.hpp"

#include <span>

namespace riesel {

/// The velocities of the grains of `mine` take up the kicks that a State has.
void take_up_kicks(Grains& grains, const Slice& mine);
/// The velocities are again those of a State.
void give_back_kicks(Grains& grains, const Slice& mine);

/// Lists what the contacts of `mine` gave to grains of other slices in this step, for whoever steps
/// them; there are so many others.
void give_away_kicks(Slice& mine, std::size_t others);

/// The kicks of the last step are forgotten; kicks and velocities of the grains of `mine` take up
/// what contacts of `mine` and of the givers gave them in this step.
void receive_kicks(State& state, const Candidates& candidates, std::span<const Slice> givers,
                   Slice& mine);

}  // namespace riesel
