// The checkpoint: everything that a run needs to go on as if it had never stopped, in one HDF5
// file.
//
// Integers and doubles are stored as they are, so that a run continues with the same bits. The file
// contains neither times nor anything else from outside: equal checkpoints are equal files, byte by
// byte. It opens like any HDF5 file (the layout is described in docs/files.md), but begins with a
// user block that holds its length and a checksum of all that follows: HDF5 itself protects the
// content of data sets only, and may crash on damaged metadata. A reader here looks at nothing
// before the seal is found whole, and hands out nothing before all of it has been checked.
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
  /// Which run it is, so that files of another are not taken for its own: equal for equal settings
  /// and starts, and kept through resumes.
  std::uint64_t run = 0;
  std::vector<std::string> warnings = {};  ///< that were given of limits, a line each
  std::int64_t rows = 0;       ///< rows that the series of the run file had at that moment
  double wall_seconds = 0.0;   ///< s, what the run has taken so far
  TimeBlocks profiles = {};    ///< what the profiles across the tube are made of, so far
  TimeBlocks histograms = {};  ///< what ended between the rows, as HistogramBlocks count it
};

/// The name of the checkpoint in the directory of a run.
inline constexpr auto checkpoint_name = "checkpoint.h5";

/// Replaces the checkpoint at `path`, and keeps the one before as NAME.previous (see
/// write_durably). Grains are stored in the order of their ids. Takes the memory of the state once
/// more. Throws FileError; in particular if no run could go on from the state: a good checkpoint is
/// not replaced by one that read_checkpoint() would refuse. Hdf5Error if memory for it lacks.
void write_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint);

/// Reads a checkpoint and checks all of it. Grains are in the order of their ids. Throws FileError
/// if the file is missing, damaged, of another format, or holds what no run can have left.
Checkpoint read_checkpoint(const std::filesystem::path& path);

struct FoundCheckpoint {
  Checkpoint checkpoint;
  std::filesystem::path path;  ///< the file it was read from
  std::string note;            ///< why that is not the newest generation; empty if it is
};

/// Reads the newest good generation of a checkpoint: that at `path` (a file, or the directory of a
/// run), else the one before. Throws FileError if there is none.
FoundCheckpoint find_checkpoint(const std::filesystem::path& path);

}  // namespace riesel::io
