// Runs the impacts of a curve and writes it.
#pragma once

#include "app/run_directory.hpp"
#include "app/verbosity.hpp"
#include "scenarios/scenario.hpp"

namespace riesel::app {

/// Returns the exit status.
int run_curve(const io::Settings& settings, const scenarios::ImpactCurve& curve,
              const RunDirectory& directory, const Arguments& arguments, Verbosity verbosity);

}  // namespace riesel::app
