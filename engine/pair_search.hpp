// Which of the candidate pairs overlap? The innermost loop of plain stepping.
//
// It looks only at coarse positions. The answer errs on the side of a hit by a few of their units;
// the contact loop then decides with all bits.
#pragma once

#include "engine/candidate_pairs.hpp"
#include "engine/cells.hpp"
#include "engine/coarse_positions.hpp"
#include "engine/selection.hpp"

#include <cstdint>
#include <vector>

namespace riesel {

/// All pairs closer than the square root of `farthest2` (m^2), with the first grain among `slots`,
/// replace those in `close`.
void find_close(const Cells& cells, SlotRange slots, const CoarsePositions& positions,
                CoarseUnits units, float farthest2, std::vector<SlotPair>& close);

/// Replaces `near` by the indices of those of `pairs`, not in contact, that are closer than the sum
/// of their radii plus `skin` (m); some more may be there.
void find_near(const CandidatePairs& pairs, const PackedPositions& positions, CoarseUnits units,
               double skin, std::vector<std::uint32_t>& near);

/// Replaces `hits` by the indices of those of `pairs`, not in contact, that may overlap, in
/// increasing order.
void find_overlapping(const CandidatePairs& pairs, const PackedPositions& positions,
                      CoarseUnits units, Selection& hits);

}  // namespace riesel
