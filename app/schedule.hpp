// When a run writes what, and when it ends.
#pragma once

#include "io/settings.hpp"
#include "scenarios/run_length.hpp"

#include <cstdint>
#include <optional>

namespace riesel::app {

/// In steps; all of it fixed by the settings, so that a resumed run has the same rhythm.
struct Schedule {
  /// `time_step` in s.
  Schedule(const io::Settings& settings, double time_step);

  bool is_row(std::int64_t step) const { return step % steps_per_row == 0; }
  bool is_frame(std::int64_t step) const {
    return steps_per_frame > 0 && step % steps_per_frame == 0;
  }
  /// When, besides with each row, it is looked whether the run is still what it should be.
  bool is_look(std::int64_t step) const {
    return step % scenarios::steps_per_look == 0 || step == last_step;
  }
  /// The next step at which something is due.
  std::int64_t next(std::int64_t step) const;

  std::int64_t last_step;
  std::optional<double> relative_error;  ///< of the mean velocity, to stop at before the last step
  std::int64_t steps_per_row;
  std::int64_t steps_per_frame = 0;    ///< of the trajectory; 0: there is none
  double seconds_between_checkpoints;  ///< on the clock
};

}  // namespace riesel::app
