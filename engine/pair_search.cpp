#include "engine/pair_search.hpp"

#include "engine/vector_kernel.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

namespace riesel {

namespace {

constexpr std::size_t block = 64;  // pairs tested at a time: their results make one 64-bit word

/// result[p] = 1 where pair p may overlap.
[[gnu::always_inline]] inline void test_block(const std::uint32_t* first,
                                              const std::uint32_t* second, const float* reach2,
                                              const std::int32_t* x, const std::int32_t* y,
                                              CoarseUnits units, std::size_t count,
                                              std::uint8_t* result) {
#pragma omp simd
  for (std::size_t p = 0; p < count; ++p) {
    const std::uint32_t i = first[p], j = second[p];
    const float dx = static_cast<float>(coarse_difference(x[j], x[i])) * units.x;
    const float dy = static_cast<float>(coarse_difference(y[j], y[i])) * units.y;
    result[p] = dx * dx + dy * dy < reach2[p];
  }
}

/// Calls visit(k) for the nonzero results k < count; most words of results are zero. What stands
/// between count and the next multiple of 8 is read.
template <class Visit>
[[gnu::always_inline]] inline void for_each_set(const std::uint8_t* result, std::size_t count,
                                                Visit visit) {
  for (std::size_t word = 0; word < count; word += sizeof(std::uint64_t)) {
    std::uint64_t bytes = 0;
    std::memcpy(&bytes, result + word, sizeof bytes);
    for (; bytes != 0; bytes &= bytes - 1) {
      const std::size_t k = word + static_cast<std::size_t>(std::countr_zero(bytes)) / 8;
      if (k < count) visit(k);
    }
  }
}

RIESEL_VECTOR_KERNEL void find_pairs(const CandidatePairs& pairs, const CoarsePositions& positions,
                                     CoarseUnits units, std::vector<std::uint32_t>& hits) {
  hits.clear();
  alignas(cache_line) std::array<std::uint8_t, block> result{};
  for (std::size_t p = 0; p < pairs.size(); p += block) {
    const std::size_t count = std::min(block, pairs.size() - p);
    test_block(&pairs.first[p], &pairs.second[p], &pairs.reach2[p], positions.x.data(),
               positions.y.data(), units, count, result.data());
    for_each_set(result.data(), count,
                 [&](std::size_t k) { hits.push_back(static_cast<std::uint32_t>(p + k)); });
  }
}

/// Appends those of the slots that are close to grain i, a vector of slots at a time.
[[gnu::always_inline]] inline void find_close_in(SlotRange range, std::size_t i,
                                                 const CoarsePositions& positions,
                                                 CoarseUnits units, float farthest2,
                                                 std::vector<SlotPair>& close) {
  constexpr std::size_t lanes = CoarsePositions::padding;
  const std::int32_t *x = positions.x.data(), *y = positions.y.data();
  const std::int32_t x_i = x[i], y_i = y[i];
  alignas(cache_line) std::array<std::uint8_t, lanes> result{};
  for (std::size_t j = range.begin; j < range.end; j += lanes) {
#pragma omp simd
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const float dx = static_cast<float>(coarse_difference(x[j + lane], x_i)) * units.x;
      const float dy = static_cast<float>(coarse_difference(y[j + lane], y_i)) * units.y;
      result[lane] = dx * dx + dy * dy < farthest2;
    }
    const std::size_t count = std::min(lanes, range.end - j);
    for_each_set(result.data(), count, [&](std::size_t lane) {
      close.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j + lane)});
    });
  }
}

RIESEL_VECTOR_KERNEL void find_close_pairs(const Cells& cells, SlotRange slots,
                                           const CoarsePositions& positions, CoarseUnits units,
                                           float farthest2, std::vector<SlotPair>& close) {
  close.clear();
  for (std::size_t i = slots.begin; i < slots.end; ++i)
    cells.for_each_later_range(
        i, [&](SlotRange range) { find_close_in(range, i, positions, units, farthest2, close); });
}

void find_at_walls(Slice& slice, const State& state) {
  slice.wall_hits.clear();
  for (std::size_t place = 0; place < slice.near_walls.size(); ++place) {
    const NearWall& near = slice.near_walls[place];
    const WallLattice& wall = state.walls[static_cast<std::size_t>(near.wall)];
    const double distance = std::abs(state.box.metres_x(state.grains.x[near.slot]) - wall.line);
    if (distance < state.grains.radius[near.slot] + wall.radius)
      slice.wall_hits.push_back(static_cast<std::uint32_t>(place));
  }
}

}  // namespace

void find_close(const Cells& cells, SlotRange slots, const CoarsePositions& positions,
                CoarseUnits units, float farthest2, std::vector<SlotPair>& close) {
  find_close_pairs(cells, slots, positions, units, farthest2, close);
}

void find_overlapping(Slice& slice, const State& state, const CoarsePositions& positions,
                      CoarseUnits units) {
  find_pairs(slice.pairs, positions, units, slice.hits);
  find_at_walls(slice, state);
}

}  // namespace riesel
