#include "engine/kicks.hpp"

#include "engine/contact_loop.hpp"

#include <algorithm>

namespace riesel {

namespace {

/// Whether `giver` may have given something to grains of `mine`.
bool concerns(const Slice& giver, const Slice& mine) {
  return &giver != &mine && !giver.given_away.empty() && giver.given_first < mine.end
         && giver.given_last >= mine.begin;
}

}  // namespace

void give_away_kicks(Slice& mine, std::size_t others) {
  mine.given_away.clear();
  if (others == 0) return;
  for_each_kick(mine, [&](std::int64_t place, const BodyKick& kick) {
    const auto slot = static_cast<std::uint32_t>(place);
    if (mine.owns(slot)) return;
    const bool first = mine.given_away.empty();
    mine.given_first = first ? slot : std::min(mine.given_first, slot);
    mine.given_last = first ? slot : std::max(mine.given_last, slot);
    mine.given_away.push_back({slot, kick});
  });
}

void receive_kicks(Grains& grains, std::span<const Slice> givers, Slice& mine) {
  for (const Kick& old : mine.received) grains.kick_x[old.slot] = grains.kick_y[old.slot] = 0;
  if (grains.rotate())
    for (const Kick& old : mine.received) grains.spin_kick[old.slot] = 0;
  std::size_t most = 2 * mine.pair_contacts.size() + mine.wall_contacts.size(), count = 0;
  for (const Slice& giver : givers) most += concerns(giver, mine) ? giver.given_away.size() : 0;
  mine.received.resize(most);
  const auto receive = [&](const Kick& kick) {
    if (!mine.owns(kick.slot)) return;
    grains.kick_x[kick.slot] = wrapped_sum(grains.kick_x[kick.slot], kick.by.x);
    grains.kick_y[kick.slot] = wrapped_sum(grains.kick_y[kick.slot], kick.by.y);
    mine.received[count++] = kick;
  };
  for_each_kick(mine, [&](std::int64_t place, const BodyKick& kick) {
    receive({static_cast<std::uint32_t>(place), kick});
  });
  for (const Slice& giver : givers)
    if (concerns(giver, mine))
      std::for_each(giver.given_away.begin(), giver.given_away.end(), receive);
  mine.received.resize(count);
  if (!grains.rotate()) return;
  for (const Kick& kick : mine.received)
    grains.spin_kick[kick.slot] = wrapped_sum(grains.spin_kick[kick.slot], kick.by.spin);
}

}  // namespace riesel
