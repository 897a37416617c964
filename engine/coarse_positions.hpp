// The upper halves of the coordinates: half the memory, twice the lanes, and the nearest image
// along y is still integer overflow.
#pragma once

#include "engine/aligned.hpp"
#include "engine/box.hpp"

#include <cstddef>
#include <cstdint>

namespace riesel {

constexpr std::int32_t coarse_difference(std::int32_t a, std::int32_t b) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) - static_cast<std::uint32_t>(b));
}

/// The length of one unit of a coarse position along each axis.
struct CoarseUnits {
  explicit CoarseUnits(const Box& box)
      : x(static_cast<float>(box.quantum_x() * 0x1p32)),
        y(static_cast<float>(box.quantum_y() * 0x1p32)) {}
  float x, y;  ///< m

  /// m^2, of a displacement in units. The one way to measure it: that no overlap is missed rests on
  /// all who look getting the same.
  [[gnu::always_inline]] float square(std::int32_t dx, std::int32_t dy) const {
    const float metres_x = static_cast<float>(dx) * x, metres_y = static_cast<float>(dy) * y;
    return metres_x * metres_x + metres_y * metres_y;
  }

  /// (reach + resolution)^2 in m^2, rounded up: no pair closer than `reach` (m) is farther in
  /// coarse positions.
  float generous_square(double reach) const {
    // Each coarse coordinate is cut by less than one unit; float arithmetic adds some 1e-7
    // relative.
    const double padded = reach + 2.0 * (static_cast<double>(x) + static_cast<double>(y));
    return static_cast<float>(padded * padded * (1.0 + 1e-6));
  }
};

/// Upper halves of the positions of all grains, by slot.
struct CoarsePositions {
  /// So many elements more can be read, whatever they hold.
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

}  // namespace riesel
