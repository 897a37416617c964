#include "bench/traffic.hpp"

#include "engine/candidates.hpp"

namespace riesel::bench {

double plain_traffic(const State& state) {
  State copy = state;
  Candidates candidates(copy, CappedSlip{}, 1, Candidates::plain_stepping, 1);
  Slice& all = candidates.slices().front();
  PackedPositions positions;
  positions.copy_all(candidates.when_sorted());
  all.inner.keep_up(all.pairs, positions, candidates.units());
  const auto per_grain = [&](std::size_t count) {
    return static_cast<double>(count) / static_cast<double>(state.grains.size());
  };

  // The drift: for each axis the displacement is read, the position read and written; the coarse
  // position is written, for which its line is read.
  constexpr double drift = 2.0 * 3.0 * sizeof(Fixed) + 2.0 * sizeof(PackedPoint);
  // The search: each pair of the inner list, and the coarse positions again.
  constexpr double pair = 2.0 * sizeof(std::uint32_t) + sizeof(float);
  constexpr double coarse = sizeof(PackedPoint);
  constexpr double near_wall = sizeof(NearWall);
  // A contact between grains: of its life the rows that change in a step are read and written, and
  // so is the relative motion in it (two positions, two displacements, two last kicks); its
  // constants (two places, reach, three masses) are read, its kicks and flags written. Each kick is
  // then added to the kick and to the velocity of its grain, which is listed, as its kick is to be
  // forgotten in the next step. The kicks of its grains are gathered.
  constexpr double changing_rows = 9.0;  // carry_on() in contact_kernel.cpp, of friction alone
  constexpr double life = 2.0 * (changing_rows * sizeof(double) + 6.0 * sizeof(Fixed));
  constexpr double constants = 2.0 * sizeof(std::int64_t) + 4.0 * sizeof(double);
  constexpr double results = 4.0 * sizeof(Fixed) + sizeof(std::int32_t);
  constexpr double grain = 12.0 * sizeof(Fixed) + 2.0 * sizeof(std::uint32_t);
  constexpr double contact = life + constants + results + 2.0 * grain;
  return drift + coarse + pair * per_grain(all.inner.pairs().size())
         + near_wall * per_grain(all.near_walls.size())
         + contact * per_grain(state.contacts.size());
}

}  // namespace riesel::bench
