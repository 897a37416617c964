// A corrugated wall: a row of equal, fixed grains, known in closed form.
//
// Which wall grains are near follows from index arithmetic on the fixed-point ring; nothing is
// stored per wall grain, and the wall of a long tube costs as much memory as that of a short one.
#pragma once

#include "engine/box.hpp"

#include <algorithm>
#include <cstdint>

namespace riesel {

/// Parallel to y: grain k stands at y = k length / count, k = 0 ... count-1.
struct WallLattice {
  double line;         ///< m, x of the centres
  double radius;       ///< m
  std::int64_t count;  ///< grains per period of the box, at least 1

  double spacing(const Box& box) const { return box.length / static_cast<double>(count); }  ///< m

  /// y of grain k, 0 <= k < count, in quanta; off by less than `count` quanta.
  Fixed place(std::int64_t k) const {
    return wrapped_product(k, static_cast<Fixed>(UINT64_MAX / static_cast<std::uint64_t>(count)));
  }
};

/// Calls visit(k, y) for all wall grains whose y is within `reach` (m) of `y`, and a few more, in
/// increasing k.
template <class Visit>
void for_each_wall_grain_within(const WallLattice& wall, const Box& box, Fixed y, double reach,
                                Visit visit) {
  __extension__ using Wide = unsigned __int128;
  const auto below = static_cast<std::int64_t>(
      (static_cast<Wide>(static_cast<std::uint64_t>(y)) * static_cast<Wide>(wall.count)) >> 64);
  const auto more = static_cast<std::int64_t>(reach / wall.spacing(box));
  const std::int64_t n = wall.count;
  const std::int64_t low = below - more, high = below + 1 + more;

  const auto visit_all = [&](std::int64_t from, std::int64_t to) {
    for (std::int64_t k = from; k <= to; ++k) visit(k, wall.place(k));
  };
  if (high - low + 1 >= n) {
    visit_all(0, n - 1);
  } else if (low < 0) {  // the neighbours lie on both sides of the seam
    visit_all(0, high);
    visit_all(low + n, n - 1);
  } else if (high >= n) {
    visit_all(0, high - n);
    visit_all(low, n - 1);
  } else {
    visit_all(low, high);
  }
}

}  // namespace riesel
