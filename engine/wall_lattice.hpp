// A wall. Corrugated: a row of equal, fixed grains, known in closed form. Smooth: a plane, which is
// a row of points so close that one of them is level with whoever asks.
//
// Which wall grains are near follows from index arithmetic on the fixed-point ring; nothing is
// stored per wall grain, and the wall of a long tube costs as much memory as that of a short one.
#pragma once

#include "engine/box.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace riesel {

/// How a wall moves along y: start + velocity t + amplitude sin(2 pi frequency t).
struct WallMotion {
  double velocity = 0.0;   ///< m/s
  double amplitude = 0.0;  ///< m, less than half a period of the box
  double frequency = 0.0;  ///< 1/s
  Fixed start = 0;         ///< quanta, from where an earlier run had moved it

  bool oscillates() const { return amplitude != 0.0 && frequency != 0.0; }
  /// Whether the wall is ever elsewhere than at first.
  bool is_there() const { return velocity != 0.0 || oscillates() || start != 0; }
  /// m/s, of the oscillation alone.
  double fastest_oscillation() const {
    return std::abs(2.0 * std::numbers::pi * frequency * amplitude);
  }
  /// m, the same at `time` (s), for whoever looks.
  double way(const Box& box, double time) const {
    return box.metres_y(start) + velocity * time
           + amplitude * std::sin(2.0 * std::numbers::pi * frequency * time);
  }
  /// Whether no step and no oscillation goes as far as half the period.
  bool is_within(const Box& box, double time_step) const {
    const double farthest =
        std::abs(amplitude) + (std::abs(velocity) + fastest_oscillation()) * time_step;
    return std::isfinite(frequency) && farthest < 0.499 * box.length;
  }
  /// Quanta of y at `step`. What is done at constant velocity is an equal number of
  /// quanta in each step.
  Fixed shift(const Box& box, double time_step, std::int64_t step) const {
    const Fixed per_step = nearest_fixed(velocity * time_step / box.quantum_y());
    const Fixed steady = wrapped_sum(start, wrapped_product(step, per_step));
    if (!oscillates()) return steady;
    const double phase = 2.0 * std::numbers::pi * frequency * time_step * static_cast<double>(step);
    return wrapped_sum(steady, nearest_fixed(amplitude * std::sin(phase) / box.quantum_y()));
  }
};

/// Parallel to y: grain k stands at y = k length / count, k = 0 ... count-1, and as far from there
/// as the wall has moved.
struct WallLattice {
  double line;         ///< m, x of the centres
  double radius;       ///< m; 0: smooth
  std::int64_t count;  ///< grains per period of the box, at least 1; 0: smooth
  WallMotion motion = {};

  static WallLattice smooth_at(double line) { return {.line = line, .radius = 0.0, .count = 0}; }
  bool smooth() const { return count == 0; }
  /// Whether it can be one: of the number and the size of its grains.
  bool sound() const {
    return smooth() ? radius == 0.0 : count > 0 && radius > 0.0 && std::isfinite(radius);
  }
  /// How many bodies it has that can be touched: a plane is one.
  std::int64_t partners() const { return smooth() ? 1 : count; }
  /// m, of the smaller body where a grain of this radius touches: a plane has no size.
  double smaller_radius(double grain) const { return smooth() ? grain : std::min(grain, radius); }
  double spacing(const Box& box) const {  ///< m; 0 where it is smooth
    return smooth() ? 0.0 : box.length / static_cast<double>(count);
  }

  /// y of grain k, 0 <= k < count, in quanta, before the wall moves; off by less than `count`
  /// quanta.
  Fixed place(std::int64_t k) const {
    return wrapped_product(k, static_cast<Fixed>(UINT64_MAX / static_cast<std::uint64_t>(count)));
  }
};

/// Calls visit(k, y) for all wall grains whose y is within `reach` (m) of `y`, and a few more, in
/// increasing k; of a smooth wall for its point 0, which is level. A wall that has moved is to be
/// asked about places that are as far back.
template <class Visit>
void for_each_wall_grain_within(const WallLattice& wall, const Box& box, Fixed y, double reach,
                                Visit visit) {
  if (wall.smooth()) {
    visit(std::int64_t{0}, y);
    return;
  }
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
