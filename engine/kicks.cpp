#include "engine/kicks.hpp"

#include "engine/contact_loop.hpp"

#include <algorithm>

namespace riesel {

void give_away_kicks(Slice& mine) {
  mine.given_away.clear();
  for_each_kick(mine, [&](std::int64_t place, const BodyKick& kick) {
    const auto slot = static_cast<std::uint32_t>(place);
    if (!mine.owns(slot)) mine.given_away.push_back({slot, kick});
  });
}

void receive_kicks(Grains& grains, const std::vector<Slice>& givers, Slice& mine) {
  for (const Kick& old : mine.received) grains.kick_x[old.slot] = grains.kick_y[old.slot] = 0;
  if (grains.rotate())
    for (const Kick& old : mine.received) grains.spin_kick[old.slot] = 0;
  mine.received.clear();
  const auto receive = [&](const Kick& kick) {
    if (!mine.owns(kick.slot)) return;
    grains.kick_x[kick.slot] = wrapped_sum(grains.kick_x[kick.slot], kick.by.x);
    grains.kick_y[kick.slot] = wrapped_sum(grains.kick_y[kick.slot], kick.by.y);
    mine.received.push_back(kick);
  };
  for_each_kick(mine, [&](std::int64_t place, const BodyKick& kick) {
    receive({static_cast<std::uint32_t>(place), kick});
  });
  for (const Slice& giver : givers)
    if (&giver != &mine) std::for_each(giver.given_away.begin(), giver.given_away.end(), receive);
  if (!grains.rotate()) return;
  for (const Kick& kick : mine.received)
    grains.spin_kick[kick.slot] = wrapped_sum(grains.spin_kick[kick.slot], kick.by.spin);
}

}  // namespace riesel
