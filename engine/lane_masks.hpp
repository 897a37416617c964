// What a vector loop finds of lanes, for those who look at the few that matter one by one.
//
// The loop goes block by block and makes a mask of each, with a bit for each lane: the many blocks
// without one take one look.
#pragma once

#include "engine/aligned.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace riesel {

/// A loop over 64-bit numbers takes as many lanes at once as fit into a vector of masks: with masks
/// of 32 bits these are two vectors of numbers side by side, one of which goes on while the other
/// waits for a root. That pays where a lane takes long and there are many. A mask has room for two
/// findings.
template <class Mask>
struct LaneMasks {
  /// Of a block, which is a vector of masks.
  static constexpr std::size_t lanes = cache_line / sizeof(Mask);

  /// Of each lane.
  static constexpr std::array<Mask, lanes> bits = [] {
    std::array<Mask, lanes> all{};
    for (std::size_t lane = 0; lane < lanes; ++lane) all[lane] = Mask{1} << lane;
    return all;
  }();

  AlignedVector<Mask> of_blocks;

  /// That hold `count` lanes.
  static constexpr std::size_t blocks(std::size_t count) { return (count + lanes - 1) / lanes; }
  /// `count` rounded up to whole blocks.
  static constexpr std::size_t padded(std::size_t count) { return blocks(count) * lanes; }
  void resize(std::size_t count) { of_blocks.resize(blocks(count)); }

  /// The bit of a lane for finding number 0 or 1, if it was made. To be given 0 or 1: GCC 12 makes
  /// no vectors of a selection between the bit and nothing. The bit is looked up: a shift by the
  /// lane is by a number of 32 bits, as which so many lanes go at once that with masks of 64 bits
  /// they need two vectors.
  [[gnu::always_inline]] static constexpr Mask bit_if(Mask found, std::size_t lane,
                                                      std::size_t finding = 0) {
    return (0 - found) & (bits[lane] << (finding * lanes));
  }
  /// Calls visit(lane) for those of the first `count` lanes of which this was found, in order.
  template <class Visit>
  void for_each_found(std::size_t count, Visit visit, std::size_t finding = 0) const {
    for (std::size_t block = 0; block < count; block += lanes) {
      const Mask valid = (Mask{2} << static_cast<Mask>(std::min(lanes, count - block) - 1)) - 1;
      Mask mask = (of_blocks[block / lanes] >> static_cast<Mask>(finding * lanes)) & valid;
      for (; mask != 0; mask &= mask - 1)
        visit(block + static_cast<std::size_t>(std::countr_zero(mask)));
    }
  }
};

}  // namespace riesel
