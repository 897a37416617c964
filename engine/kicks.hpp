// How the kicks of contacts reach the velocities in plain stepping.
//
// In a State the velocity is that of the last displacement, and the kick is still to be added by
// the next step. During plain stepping the kicks of a step are added to the kick and to the
// velocity of a grain at the same time, so that a kicked grain is accessed only once in a step.
#pragma once

#include "engine/candidates.hpp"
#include "engine/slice.hpp"
#include "engine/state.hpp"

#include <span>

namespace riesel {

/// Adds the kicks to the velocities of the grains of `mine`: from a State to plain stepping.
void take_up_kicks(Grains& grains, const Slice& mine);
/// Subtracts them again: from plain stepping to a State.
void give_back_kicks(Grains& grains, const Slice& mine);

/// Lists the kicks that the contacts of `mine` gave to grains of other slices in this step, in
/// mine.given_away, where these slices find them. `others` is the number of other slices.
void give_away_kicks(Slice& mine, std::size_t others);

/// Replaces the kicks of the grains of `mine` by those that the contacts of `mine` and of the
/// givers gave in this step, and adds these to the velocities.
void receive_kicks(State& state, const Candidates& candidates, std::span<const Slice> givers,
                   Slice& mine);

}  // namespace riesel
