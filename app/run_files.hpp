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
  /// New files; or those of a run that goes on from `state`, if it has `rows` rows behind it.
  /// Frames come every `steps_per_frame` steps; 0: there is no trajectory. Throws UnusableInput if
  /// a run cannot go on with what is there, io::FileError if new files cannot be written.
  RunFiles(RunDirectory directory, const io::RunOrigin& origin, std::int64_t rows,
           const State& state, std::int64_t steps_per_frame);

  const RunDirectory& directory() const { return directory_; }
  io::RunFile& record() { return record_; }
  const io::RunFile& record() const { return record_; }

  std::int64_t rows() const { return record_.rows(); }

  /// Nothing without a trajectory.
  void add_frame(const State& state);

  /// Puts all rows and frames on the disk, and `state` as the last one: before a checkpoint that
  /// counts them.
  void flush(const State& state);

private:
  RunDirectory directory_;
  io::RunFile record_;
  std::optional<io::TrajectoryFile> trajectory_;
};

}  // namespace riesel::app
