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
    const auto dx = static_cast<float>(static_cast<std::int32_t>(
                        static_cast<std::uint32_t>(x[j]) - static_cast<std::uint32_t>(x[i])))
                    * units.x;
    const auto dy = static_cast<float>(static_cast<std::int32_t>(
                        static_cast<std::uint32_t>(y[j]) - static_cast<std::uint32_t>(y[i])))
                    * units.y;
    result[p] = dx * dx + dy * dy < reach2[p];
  }
}

/// Appends the indices of the pairs with a result; most words of results are zero.
[[gnu::always_inline]] inline void collect(const std::uint8_t* result, std::size_t count,
                                           std::size_t first_pair,
                                           std::vector<std::uint32_t>& hits) {
  for (std::size_t word = 0; word < count; word += sizeof(std::uint64_t)) {
    std::uint64_t bytes = 0;
    std::memcpy(&bytes, result + word, sizeof bytes);
    for (; bytes != 0; bytes &= bytes - 1)
      hits.push_back(static_cast<std::uint32_t>(
          first_pair + word + static_cast<std::size_t>(std::countr_zero(bytes)) / 8));
  }
}

RIESEL_VECTOR_KERNEL void find_pairs(const CandidatePairs& pairs, const CoarsePositions& positions,
                                     CoarseUnits units, std::vector<std::uint32_t>& hits) {
  hits.clear();
  alignas(cache_line) std::array<std::uint8_t, block> result{};
  for (std::size_t p = 0; p < pairs.size(); p += block) {
    const std::size_t count = std::min(block, pairs.size() - p);
    if (count < block) result.fill(0);
    test_block(&pairs.first[p], &pairs.second[p], &pairs.reach2[p], positions.x.data(),
               positions.y.data(), units, count, result.data());
    collect(result.data(), count, p, hits);
  }
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

void find_overlapping(Slice& slice, const State& state, const CoarsePositions& positions,
                      CoarseUnits units) {
  find_pairs(slice.pairs, positions, units, slice.hits);
  find_at_walls(slice, state);
}

}  // namespace riesel
