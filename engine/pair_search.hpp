// Which of the candidate pairs overlap? The innermost loop of plain stepping.
//
// It looks only at the upper 32 bits of the coordinates: half the memory, twice the lanes, and the
// nearest image along y is still integer overflow. The answer errs on the side of a hit by a few
// units of the coarse position; the contact loop then decides with all bits.
#pragma once

#include "engine/aligned.hpp"
#include "engine/box.hpp"
#include "engine/slice.hpp"
#include "engine/state.hpp"

#include <cstdint>

namespace riesel {

/// Upper halves of the positions of all grains, by slot.
struct CoarsePositions {
  AlignedVector<std::int32_t> x, y;
};

/// The length of one unit of a coarse position along each axis.
struct CoarseUnits {
  explicit CoarseUnits(const Box& box)
      : x(static_cast<float>(box.quantum_x() * 0x1p32)),
        y(static_cast<float>(box.quantum_y() * 0x1p32)) {}
  float x, y;  ///< m

  /// (reach + resolution)^2 in m^2, rounded up: no pair closer than `reach` (m) is farther in
  /// coarse positions.
  float generous_square(double reach) const {
    // Each coarse coordinate is cut by less than one unit; float arithmetic adds some 1e-7
    // relative.
    const double generous = reach + 2.0 * (static_cast<double>(x) + static_cast<double>(y));
    return static_cast<float>(generous * generous * (1.0 + 1e-6));
  }
};

/// Writes to slice.hits and slice.wall_hits the indices of the candidates that may overlap, in
/// increasing order.
void find_overlapping(Slice& slice, const State& state, const CoarsePositions& positions,
                      CoarseUnits units);

}  // namespace riesel
