// trajectory.h5: the grains frame by frame, in one file that H5MD readers, AMBER's netCDF readers
// (OVITO), h5py and, with trajectory.xdmf2 beside it, ParaView open directly.
//
// A trajectory is too large to be built in memory like run.h5, and HDF5's library cannot append
// such that the file is whole after a kill at any moment. So the outline of the file
// (hdf5_outline.hpp) is in one of two places, and frames are written where no outline points to or,
// after a resume, over frames that come again with the same bits:
//
//   head     512 bytes: HDF5's superblock, and what is needed to continue the file
//   arrays   what belongs to no frame: radii, masses, ids, walls
//   ...      blocks of frames and the two places for outlines, in the order in which they came
//
//   append   writes a frame into the last block, or into a new one at the end of the file
//   commit   frames to the disk (fsync); a new outline into the place that is not in use, fsync;
//            the head, which is one write within a sector, and points to the new outline, fsync
//
// Until the head is written the file is the old one, and then it is the new one. An outline that no
// longer fits gets a place twice its size; the abandoned places together are smaller than the two
// in use.
#pragma once

#include "engine/state.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

namespace riesel::io {

inline constexpr auto trajectory_name = "trajectory.h5";
/// Beside it: tells ParaView where its arrays are. Replaced with each commit.
inline constexpr auto trajectory_index_name = "trajectory.xdmf2";

class TrajectoryFile {
public:
  /// A new file without frames, on the disk at once. `run`: see Checkpoint::run. `settings`: the
  /// effective ones. Frames will come every `steps_per_frame` steps from step 0 on. Throws
  /// FileError, as all members do; in particular if the file exists.
  static TrajectoryFile create(const std::filesystem::path& path, std::uint64_t run,
                               const State& state, std::int64_t steps_per_frame,
                               const std::string& settings);

  /// Continues the file of a run that is resumed: keeps the frames that were due up to the step of
  /// `state`. Until the next commit the file on the disk still holds all its frames, as those that
  /// come again are overwritten with the same bits. Throws FileError; in particular if it has too
  /// few frames, is damaged, or belongs to another run.
  static TrajectoryFile reopen(const std::filesystem::path& path, std::uint64_t run,
                               const State& state, std::int64_t steps_per_frame,
                               const std::string& settings);

  ~TrajectoryFile();
  TrajectoryFile(TrajectoryFile&&) noexcept;
  TrajectoryFile& operator=(TrajectoryFile&&) noexcept;
  TrajectoryFile(const TrajectoryFile&) = delete;
  TrajectoryFile& operator=(const TrajectoryFile&) = delete;

  /// Adds a frame, which readers see after the next commit.
  void append(const State& state);

  /// Frames so far, committed or not.
  std::int64_t frames() const;

  /// On return all frames so far are on the disk, whatever happens later. If it throws, the file is
  /// still whole, with the frames of this commit or of the one before. As it is not known which,
  /// any further commit through this object throws std::logic_error; the run can be resumed.
  void commit();

private:
  class Contents;
  explicit TrajectoryFile(std::unique_ptr<Contents> contents);

  std::unique_ptr<Contents> contents_;
};

/// Bytes that a frame of `state` takes in the file, and in the index.
struct FrameSize {
  std::uint64_t file, index;
};
FrameSize size_of_frame(const State& state);

}  // namespace riesel::io
