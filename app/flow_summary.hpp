// From the series of a flow to its result: the steady mean with its error bar, and the balances.
#pragma once

#include "engine/observables.hpp"
#include "io/run_file.hpp"
#include "io/summary.hpp"
#include "scenarios/scenario.hpp"

namespace riesel::app {

/// All but `run`. `last` are the observables of `state`, `interval` (s) is the time between two
/// rows of the series.
io::FlowSummary summarise(const io::RunFile& file, const State& state, const ContactModel& model,
                          const Observables& last, double interval);

}  // namespace riesel::app
