// What has been measured of a flow: the latest observables, and the sums for its profiles and
// histograms.
#pragma once

#include "engine/histogram_blocks.hpp"
#include "engine/observables.hpp"
#include "engine/simulation.hpp"
#include "engine/tube_profiles.hpp"

namespace riesel::app {

class FlowMeasurements {
public:
  /// For a flow that begins with `start`.
  explicit FlowMeasurements(const State& start);
  /// For a flow that goes on from `start`, with the sums so far, of as many columns as there are
  /// strips. Throws std::invalid_argument if those of the histograms do not fit.
  FlowMeasurements(const State& start, TimeBlocks profiles, TimeBlocks histograms);

  /// Updates last() only.
  void look(const State& state) { last_ = observe(state); }

  /// Updates last() and adds to the sums: once for each row of the series.
  void add(const Simulation& simulation);

  const Observables& last() const { return last_; }
  const Strips& strips() const { return strips_; }
  const TimeBlocks& profiles() const { return profiles_; }
  const TimeBlocks& histograms() const { return histograms_.blocks(); }

private:
  Strips strips_;
  TimeBlocks profiles_;
  HistogramBlocks histograms_;
  Observables last_;
};

}  // namespace riesel::app
