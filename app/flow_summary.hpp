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
  const SteadyState& steady;  ///< the assessment of the series that judged_by() names
  const Strips& strips;
  const TimeBlocks& profiles;                ///< a sample of the strips with each row of the series
  double interval;                           ///< s, between two rows
  const std::vector<std::string>& warnings;  ///< given because limits were exceeded
};

/// The names of the series by which a flow is judged steady (FlowSeries): its mean axial velocity
/// and its granular temperature, the latter first if gravity does not drive it along the walls.
struct Judged {
  io::JudgedBy series, other;
  std::optional<double> free_fall_gain;  ///< m/s per row, of free fall; see assess_steady_state()
};
Judged judged_by(const State& state, double interval);

/// The 5 % quantile of the durations of contacts since the start, in time steps: of those between
/// grains or with walls, whichever is less. NaN while there are too few contacts.
double steps_per_contact(const State& state);

/// The summary, except for its `run` and `ended_by`. `last`: the observables of `state`.
io::FlowSummary summarise(const FlowRecords& records, const State& state, const ContactModel& model,
                          const Observables& last);

}  // namespace riesel::app
