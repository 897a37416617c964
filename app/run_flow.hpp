// Steps a flow and writes what comes of it.
#pragma once

#include "app/run_directory.hpp"
#include "io/checkpoint.hpp"
#include "scenarios/scenario.hpp"

#include <optional>

namespace riesel::app {

/// Runs `settings` from the start to its end. Returns the exit status. Prints a profile if wanted.
int run_flow(const io::Settings& settings, scenarios::Flow flow, RunDirectory directory,
             const Arguments& arguments, bool profile);

/// The same from a checkpoint of an earlier run in the same directory.
int resume_flow(const io::Settings& settings, io::Checkpoint checkpoint, RunDirectory directory,
                const Arguments& arguments, bool profile);

}  // namespace riesel::app
