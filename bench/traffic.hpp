// The bytes that plain stepping would move between memory and processor for one grain and step if
// each step went through all grains and nothing stayed in a cache from one to the next. Slices that
// go askew do better (engine/plain_steps.hpp), so that this is no bound, but a measure that stays
// the same from one result to the next. Counted from the code (engine/plain_steps.cpp,
// pair_search.cpp, contact_loop.cpp), not what a machine happened to move: docs/suite.md.
#pragma once

#include "engine/state.hpp"

namespace riesel::bench {

/// Bytes per particle-step. Sorts a copy of `state` to count its candidate pairs.
double plain_traffic(const State& state);

}  // namespace riesel::bench
