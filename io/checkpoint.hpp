// The checkpoint: everything that a run needs to go on as if it had never stopped, in one HDF5
// file.
//
// Integers and doubles are stored exactly, so that a run continues with the same bits. The file
// contains no date or anything else from outside the run: equal checkpoints are equal files, byte
// by byte. Any HDF5 reader opens it (docs/files.md describes the layout), but it begins with a user
// block, the seal (seal.hpp), which holds its length and checksums of all that follows: HDF5
// itself protects only the content of data sets, and may crash on damaged metadata. The reader here
// parses nothing before the seal has proved right, and returns nothing before everything has been
// checked.
#pragma once

#include "engine/state.hpp"
#include "engine/time_blocks.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace riesel::io {

struct Checkpoint {
  State state;
  std::string settings;  ///< the effective settings, YAML
  std::string source;    ///< the user's settings file, verbatim
  /// Identifies the run, so that files of another are not taken for its own: equal for equal
  /// settings and starts, and kept when the run is resumed.
  std::uint64_t run = 0;
  std::vector<std::string> warnings = {};  ///< about exceeded limits, one line each
  std::int64_t rows = 0;                   ///< that the series of the run file had at that moment
  double wall_seconds = 0.0;               ///< s, that the run has taken so far
  TimeBlocks profiles = {};                ///< sums for the profiles across the tube, so far
  TimeBlocks histograms = {};              ///< counts of what has ended, see HistogramBlocks
  /// The version of riesel that wrote it, if its series or profiles are of other quantities.
  std::string other_records_by = {};
};

/// The name of the checkpoint in the directory of a run.
inline constexpr auto checkpoint_name = "checkpoint.h5";

/// Replaces the checkpoint at `path`, and keeps the one before as NAME.previous (see
/// write_durably()). Grains are stored in the order of their ids. Needs as much memory again as the
/// state. Throws FileError, in particular if no run could go on from the state: a good checkpoint
/// is not replaced by one that read_checkpoint() would refuse. Throws Hdf5Error if memory runs out.
void write_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint);

/// Reads a checkpoint and checks all of it. Grains are in the order of their ids. The series or
/// profiles of one by riesel 0.14 or before are of other quantities: another run may start from it,
/// but its own cannot go on. Throws FileError if the file is missing, damaged, of another version
/// of the format, or holds what no run can have left.
Checkpoint read_checkpoint(const std::filesystem::path& path);

struct FoundCheckpoint {
  Checkpoint checkpoint;
  std::filesystem::path path;  ///< the file it was read from
  std::string note;            ///< why it is not the newest generation; empty if it is
};

/// Reads the newest good generation of a checkpoint: the one at `path` (a file, or the directory of
/// a run), or else the one before it. Throws FileError if neither is good.
FoundCheckpoint find_checkpoint(const std::filesystem::path& path);

}  // namespace riesel::io
