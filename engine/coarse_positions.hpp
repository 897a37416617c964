// The upper 32 bits of the coordinates: half the memory, and the nearest image along y still
// follows from integer overflow. Kept as two arrays for loops over consecutive grains, and with
// both in one word for loops over pairs, which are limited by the number of loads.
#pragma once

#include "engine/aligned.hpp"
#include "engine/box.hpp"
#include "engine/fixed_point.hpp"

#include <cstddef>
#include <cstdint>

namespace riesel {

constexpr std::int32_t coarse_difference(std::int32_t a, std::int32_t b) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) - static_cast<std::uint32_t>(b));
}

/// Upper halves of x and y.
struct CoarsePoint {
  std::int32_t x, y;
};

/// The length of one unit of a coarse position along each axis.
struct CoarseUnits {
  explicit CoarseUnits(const Box& box)
      : x(static_cast<float>(box.quantum_x() * 0x1p32)),
        y(static_cast<float>(box.quantum_y() * 0x1p32)) {}
  float x, y;  ///< m

  /// m^2, squared length of a displacement in coarse units. All searches must use this function:
  /// that no overlap is missed relies on their rounding alike.
  [[gnu::always_inline]] float square(std::int32_t dx, std::int32_t dy) const {
    const float metres_x = static_cast<float>(dx) * x, metres_y = static_cast<float>(dy) * y;
    return metres_x * metres_x + metres_y * metres_y;
  }
  [[gnu::always_inline]] float square(CoarsePoint p) const { return square(p.x, p.y); }

  /// (reach + resolution)^2 in m^2, rounded up: square() of a pair closer than `reach` (m) is
  /// always below it.
  float generous_square(double reach) const {
    // A coarse coordinate is less than one unit too low, and single precision has a relative error
    // of some 1e-7.
    const double padded = reach + 2.0 * (static_cast<double>(x) + static_cast<double>(y));
    return static_cast<float>(padded * padded * (1.0 + 1e-6));
  }
};

/// Upper halves of the positions of all grains, by slot.
struct CoarsePositions {
  /// Extra elements at the end that vector loops may read; their values do not matter.
  static constexpr std::size_t padding = 16;

  AlignedVector<std::int32_t> x, y;

  void resize(std::size_t grains) {
    x.resize(grains + padding);
    y.resize(grains + padding);
  }

  float squared_distance(std::size_t i, std::size_t j, CoarseUnits units) const {  ///< m^2
    return units.square(coarse_difference(x[j], x[i]), coarse_difference(y[j], y[i]));
  }
};

/// A coarse position in one word, as the number y 2^32 + x: one subtraction gives both differences,
/// and unpacked() undoes the carry from x to y. Right if the x differ by less than 2^31 units, half
/// of the representable range.
class PackedPoint {
public:
  /// Sets the upper halves of x and y. A member function because loops that assign whole objects
  /// are not vectorised.
  [[gnu::always_inline]] void set(Fixed x, Fixed y) {
    constexpr std::uint64_t upper = ~std::uint64_t{0} << 32;
    word_ = (static_cast<std::uint64_t>(y) & upper)
            + ((static_cast<std::uint64_t>(x) >> 32) ^ x_origin);
  }
  CoarsePoint point() const {
    return {static_cast<std::int32_t>(static_cast<std::uint32_t>(word_) ^ x_origin),
            static_cast<std::int32_t>(word_ >> 32)};
  }
  /// b - a as one word, for unpacked().
  [[gnu::always_inline]] static std::uint64_t difference(PackedPoint b, PackedPoint a) {
    return b.word_ - a.word_;
  }
  [[gnu::always_inline]] static CoarsePoint unpacked(std::uint64_t difference) {
    return {static_cast<std::int32_t>(difference),
            static_cast<std::int32_t>((difference + x_origin) >> 32)};
  }

private:
  static constexpr std::uint32_t x_origin = 0x80000000U;  // makes x unsigned: 0 is the least x
  std::uint64_t word_ = 0;
};

/// The packed coarse positions of all grains, by slot.
struct PackedPositions {
  AlignedVector<PackedPoint> points;

  void copy(const CoarsePositions& from, std::size_t begin, std::size_t end) {
    for (std::size_t slot = begin; slot < end; ++slot)
      points[slot].set(from_upper(from.x[slot]), from_upper(from.y[slot]));
  }
  void copy_all(const CoarsePositions& from) {
    points.resize(from.x.size());
    copy(from, 0, points.size());
  }
  CoarsePoint at(std::size_t slot) const { return points[slot].point(); }
  float squared_distance(std::size_t i, std::size_t j, CoarseUnits units) const {  ///< m^2
    return units.square(PackedPoint::unpacked(PackedPoint::difference(points[j], points[i])));
  }
};

}  // namespace riesel
