// States from which a flow cannot go on; checked with each row of its series and each look.
#pragma once

#include "engine/observables.hpp"
#include "engine/state.hpp"

#include <optional>
#include <string>

namespace riesel::app {

/// If a grain of this diameter (m) fits between the grains of a wall, a message that says so, with
/// the remedy.
std::optional<std::string> way_through_a_wall(const State& state, double diameter);

/// Throws RunFailure, with time and remedy, if grains are too fast for the fixed-point numbers that
/// hold their motion (largest_speed), or so heavy that sums of energies or impulses would overflow
/// (largest_sum).
void fail_if_out_of_range(const State& state);

/// Likewise if grains have gone through a wall. `seen` are the observables of `state`.
void fail_if_through_a_wall(const State& state, const Observables& seen);

}  // namespace riesel::app
