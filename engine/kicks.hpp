// How the kicks of contacts reach the velocities: given in one step, taken up at the beginning of
// the next.
#pragma once

#include "engine/slice.hpp"
#include "engine/state.hpp"

#include <vector>

namespace riesel {

/// Adds the kicks that the grains of `mine` received in the last step to their velocities.
void take_up_kicks(Grains& grains, const Slice& mine);

/// Lists what the contacts of `mine` gave to grains of other slices in this step, for their
/// threads.
void give_away_kicks(Slice& mine);

/// Collects what the contacts of all slices gave to the grains of `mine` in this step.
void receive_kicks(Grains& grains, const std::vector<Slice>& givers, Slice& mine);

}  // namespace riesel
