// Tells the user where the time of a run went.
#pragma once

#include "engine/simulation.hpp"

#include <cstdint>

namespace riesel::app {

/// Real time that a run has spent, s.
struct RunTimes {
  double stepping = 0.0, measuring = 0.0, output = 0.0;
};

/// Prints a table of phases with their shares, and the way of stepping in use at the end. `steps`:
/// the number of steps done in `times`.
void print_profile(const Simulation& simulation, const RunTimes& times, std::int64_t steps);

}  // namespace riesel::app
