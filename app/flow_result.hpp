// What a flow writes at its end, besides its last checkpoint.
#pragma once

#include "app/flow_measurements.hpp"
#include "app/run_files.hpp"
#include "io/summary.hpp"

#include <cstdint>

namespace riesel::app {

/// Writes the verdict, profiles and histograms into run.h5, and then summary.json, so that where
/// there is a summary, the others are complete. Means are over samples from `first` on, which are
/// `interval` (s) apart.
void write_result(const io::FlowSummary& summary, const FlowMeasurements& measurements,
                  const Tally& tally, std::int64_t first, double interval, RunFiles& files);

}  // namespace riesel::app
