// What a flow writes when it has come to its end, besides its last checkpoint.
#pragma once

#include "app/flow_measurements.hpp"
#include "app/run_files.hpp"
#include "io/summary.hpp"

#include <cstdint>

namespace riesel::app {

/// The verdict, profiles and histograms into run.h5; then summary.json: where that is, the others
/// are, too. Means are from sample `first` on; `interval` (s) lies between two.
void write_result(const io::FlowSummary& summary, const FlowMeasurements& measurements,
                  const Tally& tally, std::int64_t first, double interval, RunFiles& files);

}  // namespace riesel::app
