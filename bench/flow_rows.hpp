// Rows of the cases with many grains: all variants side by side from the same state, over the same
// steps. As all steppings lead to the same bits, each of them has the same contacts to resolve.
#pragma once

#include "bench/results.hpp"
#include "bench/start_states.hpp"

namespace riesel::bench {

/// How much to do.
struct Effort {
  int repetitions;
  double work;  ///< of a repetition, as a part of what the table of cases says
};

/// Appends the rows of a case in a size to the results, and what does not agree.
void measure_flow(const FlowCase& one, const Size& size, const StartStates& states,
                  const Effort& effort, Results& results);

}  // namespace riesel::bench
