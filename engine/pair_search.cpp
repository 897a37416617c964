#include "engine/pair_search.hpp"

#include "engine/vector_kernel.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace riesel {

namespace {

/// Pairs tested at a time: enough for vectors to be full, few enough that hardly any block has a
/// pair that may overlap, so that one test usually deals with all of it.
constexpr std::size_t block = 64;

/// Up to `block` consecutive pairs: the coarse position of each second grain relative to the first.
class PairBlock {
public:
  [[gnu::always_inline]] PairBlock(const CandidatePairs& pairs, std::size_t begin,
                                   const PackedPositions& positions, CoarseUnits units)
      : count(std::min(block, pairs.size() - begin)), reach2(&pairs.reach2[begin]), units_(units) {
    look(&pairs.first[begin], &pairs.second[begin], positions.points.data());
  }

  const std::size_t count;
  const float* const reach2;

  [[gnu::always_inline]] float squared_distance(std::size_t p) const {
    return units_.square(PackedPoint::unpacked(differences_[p]));
  }

private:
  /// Scalar on purpose: vector gathers are slower.
  RIESEL_SCALAR_KERNEL void look(const std::uint32_t* first, const std::uint32_t* second,
                                 const PackedPoint* points) {
    for (std::size_t p = 0; p < count; ++p)
      differences_[p] = PackedPoint::difference(points[second[p]], points[first[p]]);
  }

  CoarseUnits units_;
  alignas(cache_line) std::array<std::uint64_t, block> differences_;
};

/// Whether any of the pairs may overlap.
[[gnu::always_inline]] inline bool any_may_overlap(const PairBlock& b) {
  std::int32_t any = 0;
#pragma omp simd reduction(| : any)
  for (std::size_t p = 0; p < b.count; ++p) any |= b.squared_distance(p) < b.reach2[p] ? 1 : 0;
  return any != 0;
}

/// For each pair of a block 1 if it is looked for, else 0.
using Flags = std::array<std::uint8_t, block>;

RIESEL_VECTOR_KERNEL void find_pairs(const CandidatePairs& pairs, const PackedPositions& positions,
                                     CoarseUnits units, Selection& hits) {
  alignas(cache_line) Flags may_overlap;
  hits.clear();
  for (std::size_t begin = 0; begin < pairs.size(); begin += block) {
    const PairBlock some(pairs, begin, positions, units);
    if (!any_may_overlap(some)) continue;
#pragma omp simd
    for (std::size_t p = 0; p < some.count; ++p) {
      const float reach2 = some.reach2[p];
      may_overlap[p] = some.squared_distance(p) < reach2;
    }
    hits.take(list_flagged(may_overlap.data(), some.count, begin, hits.room_for(block)));
  }
}

/// Writes the indices of the pairs that are near to `near`, which must have room for all pairs;
/// returns their number.
RIESEL_VECTOR_KERNEL std::size_t list_near(const CandidatePairs& pairs,
                                           const PackedPositions& positions, CoarseUnits units,
                                           float skin, std::uint32_t* near) {
  constexpr float rounded = 1.0F + 2e-6F;  // more than the rounding errors here
  std::size_t found = 0;
  alignas(cache_line) Flags is_near;
  for (std::size_t begin = 0; begin < pairs.size(); begin += block) {
    const PairBlock some(pairs, begin, positions, units);
#pragma omp simd
    for (std::size_t p = 0; p < some.count; ++p) {
      const float far = std::sqrt(std::abs(some.reach2[p])) + skin;
      const float far2 = some.reach2[p] > 0.0F ? far * far * rounded : 0.0F;
      is_near[p] = some.squared_distance(p) < far2;
    }
    found += list_flagged(is_near.data(), some.count, begin, near + found);
  }
  return found;
}

/// Writes the pairs of grain i with the grains of `range` that are close to it to `close`, which
/// must have room for one more than range.size(); returns their number. Tests a vector of slots at
/// a time, and so reads up to CoarsePositions::padding elements beyond the end.
[[gnu::always_inline]] inline std::size_t find_close_in(SlotRange range, std::size_t i,
                                                        const CoarsePositions& positions,
                                                        CoarseUnits units, float farthest2,
                                                        SlotPair* close) {
  constexpr std::size_t lanes = CoarsePositions::padding;
  const std::int32_t *x = positions.x.data(), *y = positions.y.data();
  const std::int32_t x_i = x[i], y_i = y[i];
  std::size_t found = 0;
  alignas(cache_line) std::array<std::uint32_t, lanes> result{};  // as wide as a coordinate
  for (std::size_t j = range.begin; j < range.end; j += lanes) {
#pragma omp simd
    for (std::size_t lane = 0; lane < lanes; ++lane)
      result[lane] =
          units.square(coarse_difference(x[j + lane], x_i), coarse_difference(y[j + lane], y_i))
                  < farthest2
              ? 1
              : 0;
    const std::size_t count = std::min(lanes, range.end - j);
    // Without a branch, as in list_flagged().
    for (std::size_t lane = 0; lane < count; ++lane) {
      close[found] = {static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j + lane)};
      found += result[lane];
    }
  }
  return found;
}

RIESEL_VECTOR_KERNEL void find_close_pairs(const Cells& cells, SlotRange slots,
                                           const CoarsePositions& positions, CoarseUnits units,
                                           float farthest2, std::vector<SlotPair>& close) {
  std::size_t found = 0;
  for (std::size_t i = slots.begin; i < slots.end; ++i)
    cells.for_each_later_range(i, [&](SlotRange range) {
      if (close.size() <= found + range.size()) close.resize(2 * (found + range.size()) + 1);
      found += find_close_in(range, i, positions, units, farthest2, &close[found]);
    });
  close.resize(found);
}

}  // namespace

void find_close(const Cells& cells, SlotRange slots, const CoarsePositions& positions,
                CoarseUnits units, float farthest2, std::vector<SlotPair>& close) {
  find_close_pairs(cells, slots, positions, units, farthest2, close);
}

void find_near(const CandidatePairs& pairs, const PackedPositions& positions, CoarseUnits units,
               double skin, std::vector<std::uint32_t>& near) {
  near.resize(pairs.size());
  near.resize(list_near(pairs, positions, units, static_cast<float>(skin), near.data()));
}

void find_overlapping(const CandidatePairs& pairs, const PackedPositions& positions,
                      CoarseUnits units, Selection& hits) {
  find_pairs(pairs, positions, units, hits);
}

}  // namespace riesel
