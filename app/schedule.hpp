// When a run writes what, and when it ends.
#pragma once

#include "io/settings.hpp"
#include "scenarios/run_length.hpp"

#include <cstdint>
#include <optional>

namespace riesel::app {

/// In steps. Fixed by the settings alone, so that a resumed run writes at the same steps.
struct Schedule {
  /// `time_step` in s.
  Schedule(const io::Settings& settings, double time_step);

  bool is_row(std::int64_t step) const { return step % steps_per_row == 0; }
  bool is_frame(std::int64_t step) const {
    return steps_per_frame > 0 && step % steps_per_frame == 0;
  }
  /// Whether the run is checked at this step (limits, walls, range). It is also checked with each
  /// row.
  bool is_look(std::int64_t step) const {
    return step % scenarios::steps_per_look == 0 || step == last_step;
  }
  /// The next step at which something is due.
  std::int64_t next(std::int64_t step) const;

  std::int64_t last_step;
  std::optional<double> relative_error;  ///< of the judged mean: stop early once it is reached
  std::int64_t steps_per_row;
  std::int64_t steps_per_frame = 0;    ///< of the trajectory; 0: there is none
  double seconds_between_checkpoints;  ///< of real time
};

}  // namespace riesel::app
