#include "engine/kicks.hpp"

namespace riesel {

void take_up_kicks(Grains& grains, const Slice& mine) {
  for (const Kick& kick : mine.received) {
    grains.ux[kick.slot] = wrapped_sum(grains.ux[kick.slot], kick.x);
    grains.uy[kick.slot] = wrapped_sum(grains.uy[kick.slot], kick.y);
  }
}

void receive_kicks(Grains& grains, const std::vector<Slice>& givers, Slice& mine) {
  for (const Kick& old : mine.received) grains.kick_x[old.slot] = grains.kick_y[old.slot] = 0;
  mine.received.clear();
  for (const Slice& giver : givers)
    for (const Kick& kick : giver.kicks) {
      if (kick.slot < mine.begin || kick.slot >= mine.end) continue;
      grains.kick_x[kick.slot] = wrapped_sum(grains.kick_x[kick.slot], kick.x);
      grains.kick_y[kick.slot] = wrapped_sum(grains.kick_y[kick.slot], kick.y);
      mine.received.push_back(kick);
    }
}

}  // namespace riesel
