// The bytes that plain stepping must move between memory and processor for one grain and step,
// where the grains are so many that nothing stays in a cache from one sweep to the next. It is what
// the algorithm needs at least, counted from the code (engine/simulation.cpp, pair_search.cpp,
// contact_loop.cpp), not what a machine happened to move; docs/suite.md derives it.
#pragma once

#include "engine/state.hpp"

namespace riesel::bench {

/// Bytes per particle-step. Sorts a copy of `state` to count its candidate pairs.
double plain_traffic(const State& state);

}  // namespace riesel::bench
