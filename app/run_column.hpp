// Drops a column of beads for each gap and writes the curve.
#pragma once

#include "app/run_directory.hpp"
#include "app/verbosity.hpp"
#include "scenarios/scenario.hpp"

namespace riesel::app {

/// Returns the exit status.
int run_column(const io::Settings& settings, const scenarios::ColumnCurve& curve,
               const RunDirectory& directory, const Arguments& arguments, Verbosity verbosity);

}  // namespace riesel::app
