// Strays of plain stepping: grains that have gone farther than the candidates hold for while slices
// are ahead of each other.
//
// For that a grain must become more than twice as fast as the fastest was, within a few steps. That
// is rare, and ends when the slices are at the same step again, as then all grains are sorted. So
// nothing here is made for speed.
#include "engine/candidates.hpp"

#include <algorithm>

namespace riesel {

namespace {

/// Adds the pair (i, j), of which i is in the slice, unless it is a candidate already.
void add_candidate(Slice& mine, std::uint32_t i, std::uint32_t j, float reach2) {
  if (mine.pairs.has(i, j)) return;
  mine.pairs.add(i, j, reach2);
  mine.inner.take_back(mine.pairs, static_cast<std::uint32_t>(mine.pairs.size() - 1));
}

void add_walls(Slice& mine, std::uint32_t slot, std::size_t walls) {
  for (std::int32_t wall = 0; wall < static_cast<std::int32_t>(walls); ++wall)
    if (!mine.has_near(slot, wall)) mine.near_walls.push_back({slot, wall});
}

}  // namespace

void Candidates::catch_strays(const State& state, const PackedPositions& coarse, Slice& mine,
                              const Slice& next, std::int64_t step) const {
  if (std::max(mine.gone, next.gone) <= 0.5 * skin_) return;
  const Grains& g = state.grains;
  const CoarsePoint common = coarse_motion(step);
  const auto look = [&](std::uint32_t stray, const Slice& among) {
    for (auto j = static_cast<std::uint32_t>(among.begin); j < among.end; ++j) {
      const float reach2 = units_.generous_square(g.radius[stray] + g.radius[j]);
      if (j == stray || !(coarse.squared_distance(stray, j, units_) < reach2)) continue;
      add_candidate(mine, mine.owns(stray) ? stray : j, mine.owns(stray) ? j : stray, reach2);
    }
  };
  for (const Slice* home : {static_cast<const Slice*>(&mine), &next})
    for (auto slot = static_cast<std::uint32_t>(home->begin); slot < home->end; ++slot) {
      const double gone = distance(squared_displacement(coarse.at(slot), slot, common));
      if (gone <= 0.5 * skin_) continue;
      if (is_beyond_search(gone))
        mine.lost = first_of(mine.lost, LostGrain{step, g.id[slot], true});
      look(slot, mine);
      if (home == &mine) {
        look(slot, next);
        add_walls(mine, slot, state.walls.size());
      }
    }
}

}  // namespace riesel
