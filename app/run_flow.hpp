// Steps a flow and writes its results.
#pragma once

#include "app/flow_options.hpp"
#include "app/run_directory.hpp"
#include "io/checkpoint.hpp"
#include "scenarios/scenario.hpp"

namespace riesel::app {

/// Runs `settings` from the start to its end. Returns the exit status.
int run_flow(const io::Settings& settings, scenarios::Flow flow, RunDirectory directory,
             const Arguments& arguments, const FlowOptions& options);

/// The same from a checkpoint of an earlier run in the same directory.
int resume_flow(const io::Settings& settings, io::Checkpoint checkpoint, RunDirectory directory,
                const Arguments& arguments, const FlowOptions& options);

}  // namespace riesel::app
