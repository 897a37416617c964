// What a flow cannot go on with, looked at with each row of its series.
#pragma once

#include "engine/observables.hpp"
#include "engine/state.hpp"

#include <optional>
#include <string>

namespace riesel::app {

/// Says, with the remedy, that a grain of this diameter (m) fits between the grains of a wall, if
/// it does.
std::optional<std::string> way_through_a_wall(const State& state, double diameter);

/// Throws RunFailure, with time and remedy, if grains move so fast that nothing can be told of
/// them, nor of how they went on (largest_speed), or are so heavy that sums do not hold what they
/// do (largest_sum).
void fail_if_out_of_range(const State& state);

/// Likewise if grains have gone through a wall. `seen` is of `state`.
void fail_if_through_a_wall(const State& state, const Observables& seen);

}  // namespace riesel::app
