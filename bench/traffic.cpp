#include "bench/traffic.hpp"

#include "engine/candidates.hpp"

namespace riesel::bench {

double plain_traffic(const State& state) {
  State copy = state;
  const Candidates candidates(copy, 1);
  const Slice& all = candidates.slices().front();
  const auto per_grain = [&](std::size_t count) {
    return static_cast<double>(count) / static_cast<double>(state.grains.size());
  };

  // The drift, for each axis: the displacement is read, the position read and written, the coarse
  // position written, for which its line is read.
  constexpr double drift = 2.0 * (sizeof(Fixed) + 2.0 * sizeof(Fixed) + 2.0 * sizeof(std::int32_t));
  // The search: each pair, and the coarse positions again.
  constexpr double pair = 2.0 * sizeof(std::uint32_t) + sizeof(float);
  constexpr double coarse = 2.0 * sizeof(std::int32_t);
  constexpr double near_wall = sizeof(NearWall) + sizeof(Fixed) + sizeof(double);
  // A contact is read and written, stands in the new list and in the old one, and kicks two grains:
  // written, collected, and taken up by the velocities. Its grains' positions, displacements,
  // kicks, radii, masses and ids are gathered.
  constexpr double grain = 6.0 * sizeof(Fixed) + 2.0 * sizeof(double) + sizeof(std::int32_t);
  constexpr double contact =
      2.0 * sizeof(Contact) + 3.0 * sizeof(ContactBook::Entry) + 2.0 * (5.0 * sizeof(Kick) + grain);
  return drift + coarse + pair * per_grain(all.pairs.size())
         + near_wall * per_grain(all.near_walls.size())
         + contact * per_grain(state.contacts.size());
}

}  // namespace riesel::bench
