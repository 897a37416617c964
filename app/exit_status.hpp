// What the program returns to the shell. An interrupted run returns 128 + the signal.
#pragma once

namespace riesel::app {

inline constexpr int exit_done = 0;
inline constexpr int exit_failed = 1;       ///< the run failed
inline constexpr int exit_bad_input = 2;    ///< settings or usage
inline constexpr int exit_out_of_time = 3;  ///< --max-walltime; there is a checkpoint to go on from

/// Whether --max-walltime or a signal stopped runs, so that the same command goes on with them.
constexpr bool was_stopped(int status) { return status == exit_out_of_time || status > 128; }

}  // namespace riesel::app
