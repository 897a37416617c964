// Tells the user where the time of a run went.
#pragma once

#include "engine/simulation.hpp"

#include <cstdint>

namespace riesel::app {

/// Wall-clock time of a run, s.
struct RunTimes {
  double stepping = 0.0, measuring = 0.0, output = 0.0;
};

/// A table of phases with their shares, and how was stepped; `steps` are those done.
void print_profile(const Simulation& simulation, const RunTimes& times, std::int64_t steps);

}  // namespace riesel::app
