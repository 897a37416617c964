// The files that a flow writes while it runs: its series and, if it is asked for, its trajectory,
// in a directory that it has for itself.
#pragma once

#include "app/run_directory.hpp"
#include "engine/state.hpp"
#include "io/provenance.hpp"
#include "io/run_file.hpp"
#include "io/trajectory_file.hpp"

#include <cstdint>
#include <optional>

namespace riesel::app {

class RunFiles {
public:
  /// Creates the files if `rows` is 0; otherwise reopens those of a run that goes on from `state`
  /// after `rows` rows. Frames are `steps_per_frame` steps apart; 0: no trajectory. Throws
  /// UnusableInput if the files cannot be continued, io::FileError if they cannot be written.
  RunFiles(RunDirectory directory, const io::RunOrigin& origin, std::int64_t rows,
           const State& state, std::int64_t steps_per_frame);

  const RunDirectory& directory() const { return directory_; }
  io::RunFile& record() { return record_; }
  const io::RunFile& record() const { return record_; }

  std::int64_t rows() const { return record_.rows(); }

  /// Does nothing if there is no trajectory.
  void add_frame(const State& state);

  /// Writes all rows and frames to disk, and `state` as the final state, with the forces of its
  /// contacts. To be called before each checkpoint, which records how many rows there are.
  /// Throws io::FileError, io::Hdf5Error without memory, UnusableInput if the directory is gone.
  void flush(const State& state, const ContactModel& model);

private:
  RunDirectory directory_;
  io::RunFile record_;
  std::optional<io::TrajectoryFile> trajectory_;
};

}  // namespace riesel::app
