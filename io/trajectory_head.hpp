// The head of trajectory.h5: HDF5's superblock and, after it, where HDF5 does not look, what is
// needed to continue the file.
#pragma once

#include "io/bytes.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace riesel::io {

inline constexpr std::size_t trajectory_head_size = 512;  ///< bytes: a sector of a disk

/// A place that is reserved for an outline.
struct OutlinePlace {
  std::uint64_t address = 0, capacity = 0;  ///< bytes
};

struct TrajectoryHead {
  std::uint64_t run = 0;  ///< see Checkpoint::run
  std::uint64_t grains = 0, wall_grains = 0;
  std::uint64_t steps_per_frame = 0, frames_per_block = 0;
  std::uint64_t frames = 0;
  std::uint64_t blocks = 0;            ///< their addresses are at the beginning of the outline
  std::uint64_t end = 0;               ///< bytes; behind everything that is in use
  std::array<OutlinePlace, 2> places;  ///< for outlines
  std::uint64_t in_use = 0;            ///< which of the two places
  std::uint64_t outline_size = 0;      ///< bytes
  std::uint64_t outline_checksum = 0;  ///< FNV-1a
};

/// The bytes of the head. `root`: address of the root group.
std::string written(const TrajectoryHead& head, std::uint64_t root);

/// The head of a file. Throws Hdf5Error if it is not one or is damaged, OutOfBytes if it is too
/// short.
TrajectoryHead read_trajectory_head(const Bytes& bytes);

/// FNV-1a.
std::uint64_t checksum_of(std::string_view bytes);

}  // namespace riesel::io
