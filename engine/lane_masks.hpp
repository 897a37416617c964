// Bit masks by which a vector loop reports the few lanes that need a closer look, one by one.
//
// The loop goes block by block and makes a mask for each, with a bit for each lane: so a block
// without a finding costs a single test.
#pragma once

#include "engine/aligned.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace riesel {

/// A block is as many lanes as there are masks in a vector of 64 bytes. With masks of 64 bits a
/// block of doubles is one vector; with masks of 32 bits it is two, one of which goes on while the
/// other waits for a root: that pays where a lane takes long and there are many. A mask has room
/// for two findings per lane.
template <class Mask>
struct LaneMasks {
  /// Lanes of a block.
  static constexpr std::size_t lanes = cache_line / sizeof(Mask);

  /// The bit of each lane.
  static constexpr std::array<Mask, lanes> bits = [] {
    std::array<Mask, lanes> all{};
    for (std::size_t lane = 0; lane < lanes; ++lane) all[lane] = Mask{1} << lane;
    return all;
  }();

  AlignedVector<Mask> of_blocks;

  /// The number of blocks that hold `count` lanes.
  static constexpr std::size_t blocks(std::size_t count) { return (count + lanes - 1) / lanes; }
  /// `count` rounded up to whole blocks.
  static constexpr std::size_t padded(std::size_t count) { return blocks(count) * lanes; }
  void resize(std::size_t count) { of_blocks.resize(blocks(count)); }

  /// The bit of a lane for finding number 0 or 1 if `found` is 1, no bit if it is 0. An integer and
  /// no bool, because GCC 12 does not vectorise the choice between the bit and 0. The bit comes
  /// from a table because a shift by the lane makes GCC count lanes in 32 bits, and then masks of
  /// 64 bits take two vectors.
  [[gnu::always_inline]] static constexpr Mask bit_if(Mask found, std::size_t lane,
                                                      std::size_t finding = 0) {
    return (0 - found) & (bits[lane] << (finding * lanes));
  }
  /// Calls visit(lane), in order, for those of the first `count` lanes that have this finding.
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
