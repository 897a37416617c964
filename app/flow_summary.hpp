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
  const SteadyState& steady;  ///< assess_flow() of the series that judged_by() names
  const Strips& strips;
  const TimeBlocks& profiles;                ///< a sample of the strips with each row of the series
  double interval;                           ///< s, between two rows
  const std::vector<std::string>& warnings;  ///< given because limits were exceeded
};

/// The 5 % quantile of the durations of contacts since the start, in time steps: of those between
/// grains or with walls, whichever is less. NaN while there are too few contacts.
double steps_per_contact(const State& state);

/// The summary, except for its `run` and `ended_by`. `last`: the observables of `state`.
io::FlowSummary summarise(const FlowRecords& records, const State& state, const ContactModel& model,
                          const Observables& last);

}  // namespace riesel::app
