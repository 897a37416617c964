#include "engine/kicks.hpp"

#include "engine/contact_loop.hpp"
#include "engine/vector_kernel.hpp"

#include <algorithm>

namespace riesel {

namespace {

/// Whether `giver`, another slice, may have kicks for grains of `mine`.
bool concerns(const Slice& giver, const Slice& mine) {
  return &giver != &mine && !giver.given_away.empty() && giver.given_first < mine.end
         && giver.given_last >= mine.begin;
}

/// Adds kicks to the grains of a slice. Has copies of all that a kick needs, so that the compiler
/// can keep them in registers.
struct Receiver {
  FixedVector *kick, *u;
  Fixed *spin_kick, *spin;  // null where grains do not rotate, and no kick has a spin
  std::size_t begin, size;  // slots
  Candidates::Speedometer speed;
  double fastest2;        // as in the slice
  std::uint32_t* kicked;  // where the next kicked slot is written

  /// Returns the new sum.
  [[gnu::always_inline]] static Lanes add(FixedVector& sum, Lanes more) {
    const Lanes now = lanes_of(sum) + more;
    put(now, sum);
    return now;
  }
  static void add(Fixed& sum, Fixed more) { sum = wrapped_sum(sum, more); }

  [[gnu::always_inline]] void operator()(std::int64_t place, const BodyKick& by) {
    const auto slot = static_cast<std::uint32_t>(place);
    if (slot - begin >= size) return;
    *kicked++ = slot;
    const Lanes more = lanes_of(by.by);
    add(kick[slot], more);
    fastest2 = std::max(fastest2, speed.squared(add(u[slot], more)));
    if (by.spin != 0) {
      add(spin_kick[slot], by.spin);
      add(spin[slot], by.spin);
    }
  }
};

/// Adds the kicks by contacts of the own slice.
RIESEL_VECTOR_KERNEL void receive_own(const LiveContacts& contacts, Receiver* receiver) {
  Receiver mine = *receiver;
  contacts.for_each_kick(mine);
  *receiver = mine;
}

/// u = change(u, kick) for all grains of the slice, and likewise for the spins.
template <class Change>
void change_velocities(Grains& g, const Slice& mine, Change change) {
  for (std::size_t i = mine.begin; i < mine.end; ++i) g.u[i] = change(g.u[i], g.kick[i]);
  if (!g.rotate()) return;
  for (std::size_t i = mine.begin; i < mine.end; ++i) g.spin[i] = change(g.spin[i], g.spin_kick[i]);
}

}  // namespace

void take_up_kicks(Grains& grains, const Slice& mine) {
  change_velocities(grains, mine, [](const auto& u, const auto& by) { return wrapped_sum(u, by); });
}

void give_back_kicks(Grains& grains, const Slice& mine) {
  change_velocities(grains, mine,
                    [](const auto& u, const auto& by) { return wrapped_difference(u, by); });
}

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

void receive_kicks(State& state, const Candidates& candidates, std::span<const Slice> givers,
                   Slice& mine) {
  Grains& g = state.grains;
  for (const std::uint32_t slot : mine.kicked) g.kick[slot] = {};
  if (g.rotate())
    for (const std::uint32_t slot : mine.kicked) g.spin_kick[slot] = 0;
  std::size_t most = 2 * mine.pair_contacts.size() + mine.wall_contacts.size();
  for (const Slice& giver : givers) most += concerns(giver, mine) ? giver.given_away.size() : 0;
  mine.kicked.resize(most);
  Receiver receiver{.kick = g.kick.data(),
                    .u = g.u.data(),
                    .spin_kick = g.spin_kick.data(),
                    .spin = g.spin.data(),
                    .begin = mine.begin,
                    .size = mine.end - mine.begin,
                    .speed = candidates.speedometer(state.box),
                    .fastest2 = mine.fastest2,
                    .kicked = mine.kicked.data()};
  receive_own(mine.pair_contacts, &receiver);
  receive_own(mine.wall_contacts, &receiver);
  for (const Slice& giver : givers)
    if (concerns(giver, mine))
      for (const Kick& kick : giver.given_away) receiver(kick.slot, kick.by);
  mine.kicked.resize(static_cast<std::size_t>(receiver.kicked - mine.kicked.data()));
  mine.fastest2 = receiver.fastest2;
}

}  // namespace riesel
