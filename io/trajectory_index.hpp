// The index that tells ParaView where the arrays of trajectory.h5 are, in XDMF 2. ParaView 5.11
// reads it under the ending .xdmf2; for .xdmf it chooses a reader that cannot.
#pragma once

#include <cstdint>
#include <string>

namespace riesel::io {

struct TrajectoryIndex {
  std::string file;  ///< the name of the trajectory, in the same directory
  std::uint64_t grains, wall_grains, frames;
  bool walls_move, grains_rotate;
  double interval;  ///< s, between two frames
};

/// The text of the index.
std::string trajectory_index(const TrajectoryIndex& index);

}  // namespace riesel::io
