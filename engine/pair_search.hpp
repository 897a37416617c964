// Which of the candidate pairs overlap? The innermost loop of plain stepping.
//
// It compares coarse positions only, and so may report pairs that are a few coarse units too far
// apart, but misses none; the contact loop then decides with all bits.
#pragma once

#include "engine/candidate_pairs.hpp"
#include "engine/cells.hpp"
#include "engine/coarse_positions.hpp"
#include "engine/selection.hpp"

#include <cstdint>
#include <vector>

namespace riesel {

/// Replaces the content of `close` by all pairs closer than the square root of `farthest2` (m^2)
/// whose first grain is among `slots`.
void find_close(const Cells& cells, SlotRange slots, const CoarsePositions& positions,
                CoarseUnits units, float farthest2, std::vector<SlotPair>& close);

/// Replaces `near` by the indices of those of `pairs`, not in contact, that are closer than the sum
/// of their radii plus `skin` (m), and perhaps some that are a little farther apart.
void find_near(const CandidatePairs& pairs, const PackedPositions& positions, CoarseUnits units,
               double skin, std::vector<std::uint32_t>& near);

/// Replaces `hits` by the indices of those of `pairs`, not in contact, that may overlap, in
/// increasing order.
void find_overlapping(const CandidatePairs& pairs, const PackedPositions& positions,
                      CoarseUnits units, Selection& hits);

}  // namespace riesel
