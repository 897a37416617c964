// What a flow has been seen to do: the last look at it, and the sums for its profiles and
// histograms.
#pragma once

#include "engine/histogram_blocks.hpp"
#include "engine/observables.hpp"
#include "engine/simulation.hpp"
#include "engine/tube_profiles.hpp"

namespace riesel::app {

class FlowMeasurements {
public:
  /// Of a flow that begins with `start`.
  explicit FlowMeasurements(const State& start);
  /// Of one that goes on with it: `profiles` and `histograms` as they were. Throws
  /// std::invalid_argument if they cannot be.
  FlowMeasurements(const State& start, TimeBlocks profiles, TimeBlocks histograms);

  void look(const State& state) { last_ = observe(state); }

  /// A look that counts: one with each row of the series.
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
