// A wall. Corrugated: a row of equal, fixed grains, known in closed form. Smooth: a plane, which is
// treated as a single point that always has the y of the grain that is looked at.
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

/// Displacement of a wall from where it was at first.
struct WallWay {
  double x, y;  ///< m
};

/// How a wall moves: its displacement is start + velocity t along y, plus amplitude sin(phase + 2
/// pi frequency t) along each axis.
struct WallMotion {
  double velocity = 0.0;     ///< m/s
  double amplitude_x = 0.0;  ///< m, less than half the width of the box
  double amplitude_y = 0.0;  ///< m, less than half a period of the box
  double frequency = 0.0;    ///< 1/s
  double phase = 0.0;        ///< rad, at the end of an earlier run
  Fixed start = 0;           ///< quanta along y, by which an earlier run had moved it

  bool oscillates() const {
    return (amplitude_x != 0.0 || amplitude_y != 0.0) && (frequency != 0.0 || phase != 0.0);
  }
  /// Whether the wall is ever displaced.
  bool is_ever_away() const { return velocity != 0.0 || oscillates() || start != 0; }
  /// rad, at `time` (s).
  double phase_at(double time) const { return phase + 2.0 * std::numbers::pi * frequency * time; }
  /// m/s, largest speed of the oscillation alone.
  double fastest_oscillation() const {
    return std::abs(2.0 * std::numbers::pi * frequency) * std::hypot(amplitude_x, amplitude_y);
  }
  /// Displacement of the wall at `time` (s) from where it was at first. For output only: stepping
  /// uses shift().
  WallWay way(const Box& box, double time) const {
    const double swing = std::sin(phase_at(time));
    return {amplitude_x * swing, box.metres_y(start) + velocity * time + amplitude_y * swing};
  }
  /// Whether the oscillation plus one step stays within half the box along each axis.
  bool is_within(const Box& box, double time_step) const {
    const double step = (std::abs(velocity) + fastest_oscillation()) * time_step;
    return std::isfinite(phase_at(time_step)) && std::abs(amplitude_x) + step < 0.499 * box.width
           && std::abs(amplitude_y) + step < 0.499 * box.length;
  }
  /// Displacement in quanta at `step`. The part at constant velocity is the same number of quanta
  /// in each step.
  FixedVector shift(const Box& box, double time_step, std::int64_t step) const {
    const Fixed per_step = nearest_fixed(velocity * time_step / box.quantum_y());
    const Fixed steady = wrapped_sum(start, wrapped_product(step, per_step));
    if (!oscillates()) return {0, steady};
    const double swing = std::sin(phase_at(time_step * static_cast<double>(step)));
    return {nearest_fixed(amplitude_x * swing / box.quantum_x()),
            wrapped_sum(steady, nearest_fixed(amplitude_y * swing / box.quantum_y()))};
  }
};

/// A wall parallel to y. Before it moves, its grain k is at (line, k length / count), k = 0 ...
/// count-1.
struct WallLattice {
  double line;         ///< m, x of the centres
  double radius;       ///< m; 0: smooth
  std::int64_t count;  ///< grains per period of the box, at least 1; 0: smooth
  WallMotion motion = {};

  static WallLattice smooth_at(double line, const WallMotion& motion = {}) {
    return {.line = line, .radius = 0.0, .count = 0, .motion = motion};
  }
  bool smooth() const { return count == 0; }
  /// Whether the number and the radius of its grains are possible.
  bool sound() const {
    if (smooth()) return radius == 0.0;
    return count > 0 && count <= INT32_MAX && radius > 0.0 && std::isfinite(radius);
  }
  /// 1 or -1, the direction along x from the wall into the box.
  double inwards(const Box& box) const { return line < 0.5 * box.width ? 1.0 : -1.0; }
  /// m, from its line to the farthest point that it ever covers.
  double extent() const { return radius + std::abs(motion.amplitude_x); }
  /// m, distance across the tube of a grain with this radius (m) and its centre at `x` (m) from
  /// where the wall can ever be; negative within. Has rounding errors: callers that must not miss a
  /// contact have to allow for them.
  double distance_across(double x, double grain_radius) const {
    return std::abs(x - line) - (grain_radius + extent());
  }
  bool is_near(double x, double grain_radius, double room) const {
    return distance_across(x, grain_radius) < room;
  }
  /// The number of its bodies that can be touched: a plane is one.
  std::int64_t partners() const { return smooth() ? 1 : count; }
  /// m, the radius of the smaller body in a contact with a grain of radius `grain` (m): with a
  /// plane that of the grain.
  double smaller_radius(double grain) const { return smooth() ? grain : std::min(grain, radius); }
  double spacing(const Box& box) const {  ///< m; 0 where it is smooth
    return smooth() ? 0.0 : box.length / static_cast<double>(count);
  }
  /// m, between two neighbours; negative where they overlap, 0 where it is smooth.
  double gap(const Box& box) const { return spacing(box) - 2.0 * radius; }

  /// This many consecutive grains of a wall, also across the seam, always have different bits.
  static constexpr std::int64_t most_told_apart = 31;
  /// m, the least spacing with which the wall grains that one grain touches at a time are no more
  /// than that; `reach` (m) is the sum of the radii.
  static double least_spacing(double reach) {
    return 2.0 * reach / static_cast<double>(most_told_apart - 1);
  }
  /// One of 64 bits for grain k, 0 <= k < count, by which NearWall::partners tells its partners
  /// apart.
  std::uint64_t bit_of(std::int64_t k) const {
    // The bits continue across the seam as if the number of grains were a multiple of 64. The bits
    // too many are skipped at two places: skipping up to 63 at one place would repeat bits nearby.
    const std::int64_t lacking = -count & 63;
    const std::int64_t left_out =
        (3 * k >= count ? lacking / 2 : 0) + (3 * k >= 2 * count ? lacking - lacking / 2 : 0);
    return std::uint64_t{1} << ((k + left_out) & 63);
  }

  struct Place {
    double x, y;  ///< m, y in [0, length)
  };
  /// The place of grain k when the wall has this displacement. For output only.
  Place place(std::int64_t k, const WallWay& way, const Box& box) const {
    return {line + way.x, box.wrapped(static_cast<double>(k) * spacing(box) + way.y)};
  }
  /// y of grain k, 0 <= k < count, in quanta, before the wall moves; off by less than `count`
  /// quanta.
  Fixed place(std::int64_t k) const {
    return wrapped_product(k, static_cast<Fixed>(UINT64_MAX / static_cast<std::uint64_t>(count)));
  }
};

/// Calls visit(k, y of grain k) in increasing k for all wall grains whose y is within `reach` (m)
/// of `y`, and for a few more; for a smooth wall calls visit(0, y). The wall is taken where it was
/// at first: if it has moved, its displacement must be subtracted from `y`.
template <class Visit>
void for_each_wall_grain_within(const WallLattice& wall, const Box& box, Fixed y, double reach,
                                Visit visit) {
  if (wall.smooth()) {
    visit(std::int64_t{0}, y);
    return;
  }
  const std::int64_t below = part_of_ring(y, wall.count);
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
