// The time series of a flow: which observables and which sums over contacts a row of run.h5 holds.
#pragma once

#include "engine/observables.hpp"
#include "io/run_file.hpp"

#include <vector>

namespace riesel::app {

/// In the order of the columns.
std::vector<io::Column> series_columns();

/// The values of one row.
std::vector<double> series_row(const Observables& observables, const Tally& tally);

}  // namespace riesel::app
