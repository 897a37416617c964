// The test of pairs without a library, for one set of instructions: the engine keeps an answer for
// each pair, this asks whether any pair of a block may overlap and looks again where one does.
#include "bench/simd/kernels.hpp"

namespace riesel::bench::simd {

namespace {

constexpr std::size_t block = 64;

std::size_t find_pairs_by_blocks(const PairProblem& problem, std::uint32_t* hits) {
  const PairProblem p = problem;  // by value, or GCC does not make vectors of the loop
  std::uint32_t* hit = hits;
  for (std::size_t begin = 0; begin < p.count; begin += block) {
    const std::size_t end = std::min(begin + block, p.count);
    std::int32_t any = 0;
#pragma omp simd reduction(| : any)
    for (std::size_t k = begin; k < end; ++k)
      any |= may_overlap(p.first[k], p.second[k], p.reach2[k], p.x, p.y, p.units) ? 1 : 0;
    for (std::size_t k = begin; any != 0 && k < end; ++k)
      if (may_overlap(p.first[k], p.second[k], p.reach2[k], p.x, p.y, p.units))
        *hit++ = static_cast<std::uint32_t>(k);
  }
  return static_cast<std::size_t>(hit - hits);
}

}  // namespace

extern const Way RIESEL_WAY;
const Way RIESEL_WAY = {RIESEL_WAY_NAME, find_pairs_by_blocks, nullptr};

}  // namespace riesel::bench::simd
