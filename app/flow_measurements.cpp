#include "app/flow_measurements.hpp"

#include <utility>

namespace riesel::app {

FlowMeasurements::FlowMeasurements(const State& start)
    : strips_(Strips::of(start)), profiles_(strips_.columns()) {}

FlowMeasurements::FlowMeasurements(const State& start, TimeBlocks profiles, TimeBlocks histograms)
    : strips_(Strips::of(start)),
      profiles_(std::move(profiles)),
      histograms_(std::move(histograms)) {}

void FlowMeasurements::add(const Simulation& simulation) {
  const State& state = simulation.state();
  look(state);
  profiles_.add(sum_over_strips(strips_, state, simulation.model(),
                                {.vx = last_.mean_vx, .vy = last_.mean_vy}));
  histograms_.add(state.tally);
}

}  // namespace riesel::app
