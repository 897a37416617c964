// What a vector loop finds of lanes, for those who look at the few that matter one by one.
//
// The loop goes block by block, sets the flag of each lane, and that of the block if any of its
// lanes has one: the many blocks without take one look.
#pragma once

#include "engine/aligned.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace riesel {

/// A loop over 64-bit numbers takes as many lanes at once as fit into a vector of flags: with flags
/// of 32 bits these are two vectors of numbers side by side, one of which goes on while the other
/// waits for a root. That pays where a lane takes long and there are many.
template <class Flag>
struct LaneFlags {
  /// Of a block, which is a vector of flags.
  static constexpr std::size_t lanes = cache_line / sizeof(Flag);

  AlignedVector<Flag> of_lanes, of_blocks;

  /// `count` rounded up to whole blocks.
  static constexpr std::size_t padded(std::size_t count) {
    return (count + lanes - 1) / lanes * lanes;
  }
  /// `count` is one of whole blocks.
  void resize(std::size_t count) {
    of_lanes.resize(count);
    of_blocks.resize(count / lanes);
  }
  /// Calls visit(lane, flag) for those of the first `count` lanes that have one, in order.
  template <class Visit>
  void for_each_set(std::size_t count, Visit visit) const {
    for (std::size_t block = 0; block < count; block += lanes) {
      if (of_blocks[block / lanes] == 0) continue;
      for (std::size_t lane = block; lane < std::min(block + lanes, count); ++lane)
        if (of_lanes[lane] != 0) visit(lane, of_lanes[lane]);
    }
  }
};

}  // namespace riesel
