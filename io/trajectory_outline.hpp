// What readers see in a trajectory: the tree of H5MD 1.1, and beside it the names of AMBER's
// convention for netCDF-4, which is HDF5 too. Both name the same data sets.
//
// https://www.nongnu.org/h5md/h5md.html, https://ambermd.org/netcdf/nctraj.xhtml
#pragma once

#include "io/hdf5_outline.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace riesel::io {

/// What does not change during a run.
struct TrajectoryFacts {
  std::uint64_t grains;
  std::uint64_t wall_grains;
  bool walls_move = false;  ///< then each frame has the positions of their grains
  bool grains_rotate = false;
  double width, length;     ///< m, of the box; periodic along y
  double largest_diameter;  ///< m
  std::string settings;     ///< the effective settings, YAML
};

/// Addresses of the arrays that belong to no frame.
struct FixedArrays {
  std::uint64_t radius, mass, id;                               // of grains
  std::uint64_t wall_position, wall_radius, wall_id, wall_end;  // and the end of all
};

/// A block holds the same number of frames of each array, one array after the other.
struct FrameBlocks {
  std::uint64_t frames_per_block;
  std::uint64_t position, velocity, spin, wall_position, cell, step, time;  ///< offsets in a block
  std::uint64_t size;                                                       ///< bytes

  FrameBlocks(const TrajectoryFacts& facts, std::uint64_t frames);
};

/// Vectors are stored with this many components, the last of which is 0.
inline constexpr std::uint64_t trajectory_components = 3;

/// Adds to `outline` the root group of a trajectory of `frames` frames, in blocks at these
/// addresses, and everything in it. Returns the address of the group.
std::uint64_t outline_trajectory(Hdf5Outline& outline, const TrajectoryFacts& facts,
                                 const FixedArrays& fixed, const FrameBlocks& layout,
                                 const std::vector<std::uint64_t>& blocks, std::uint64_t frames);

}  // namespace riesel::io
