// From the series of a flow to its result: the steady mean with its error bar, and the balances.
#pragma once

#include "engine/observables.hpp"
#include "engine/steady_state.hpp"
#include "engine/tube_profiles.hpp"
#include "io/run_file.hpp"
#include "io/summary.hpp"
#include "scenarios/scenario.hpp"

#include <optional>
#include <string>
#include <vector>

namespace riesel::app {

/// What a flow leaves to be summarised.
struct FlowRecords {
  const io::RunFile& file;
  const SteadyState& steady;  ///< what the series says by which it is judged
  const Strips& strips;
  const TimeBlocks& profiles;                ///< a sample of the strips with each row of the series
  double interval;                           ///< s, between two rows
  const std::vector<std::string>& warnings;  ///< that were given of limits
};

/// By which of the series a flow is judged steady: its mean velocity, or how hot it is where
/// gravity does not drive it along the walls.
struct Judged {
  const char* series;
  std::optional<double> free_fall_gain;  ///< per row, for the verdict
};
Judged judged_by(const State& state, double interval);

/// Steps that the shortest twentieth of the contacts of a kind has lasted at most, since the start;
/// not a number while there are too few.
double steps_per_contact(const State& state);

/// All but `run`. `last` are the observables of `state`.
io::FlowSummary summarise(const FlowRecords& records, const State& state, const ContactModel& model,
                          const Observables& last);

}  // namespace riesel::app
