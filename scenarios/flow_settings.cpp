// The settings that all flows have in common: how long they are followed, when they are stopped,
// and what they write.
#include "scenarios/run_length.hpp"
#include "scenarios/run_limits.hpp"
#include "scenarios/scenario.hpp"

namespace riesel::scenarios {

namespace {

io::SettingsTable output_settings() {
  return {
      {.key = "output.interval",
       .unit = "s",
       .fallback = "1 ms",
       .range = io::positive(),
       .doc = "Simulated time between two rows of the time series."},
      {.key = "output.checkpoint_interval",
       .unit = "s",
       .fallback = "60 s",
       .range = io::positive(),
       .doc = "Wall-clock time between two checkpoints; the results do not depend on it.",
       .matters = false},
      {.key = "output.trajectory_interval",
       .unit = "s",
       .example = "1 ms",
       .range = io::positive(),
       .doc =
           "Simulated time between two frames of trajectory.h5 (docs/files.md). By default there "
           "is none.",
       .matters = false},
  };
}

}  // namespace

io::SettingsTable common_flow_settings() {
  io::SettingsTable table;
  for (const auto& rows : {run_length_settings(), run_limits_settings(), output_settings()})
    table.insert(table.end(), rows.begin(), rows.end());
  return table;
}

}  // namespace riesel::scenarios
