// How the kicks of contacts reach the velocities: given in one step, taken up at the beginning of
// the next.
#pragma once

#include "engine/slice.hpp"
#include "engine/state.hpp"

#include <span>

namespace riesel {

/// Adds the kicks that the grains of `mine` received in the last step to their velocities, and
/// calls taken_up(slot) after each.
template <class TakenUp>
void take_up_kicks(Grains& grains, const Slice& mine, TakenUp taken_up) {
  for (const Kick& kick : mine.received) {
    grains.ux[kick.slot] = wrapped_sum(grains.ux[kick.slot], kick.by.x);
    grains.uy[kick.slot] = wrapped_sum(grains.uy[kick.slot], kick.by.y);
    taken_up(kick.slot);
  }
  if (!grains.rotate()) return;
  for (const Kick& kick : mine.received)
    grains.spin[kick.slot] = wrapped_sum(grains.spin[kick.slot], kick.by.spin);
}

/// Lists what the contacts of `mine` gave to grains of other slices in this step, for whoever steps
/// them; there are so many others.
void give_away_kicks(Slice& mine, std::size_t others);

/// Collects what the contacts of `mine` and of the givers gave to the grains of `mine` in this
/// step.
void receive_kicks(Grains& grains, std::span<const Slice> givers, Slice& mine);

}  // namespace riesel
