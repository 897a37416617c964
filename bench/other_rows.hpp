// Rows of the cases that are not about many grains being stepped: impacts, checkpoints, start-up.
#pragma once

#include "bench/flow_rows.hpp"

namespace riesel::bench {

/// All impacts of a curve, on one and on two threads.
void measure_impacts(const ImpactCase& one, const Effort& effort, Results& results);

/// Writing and reading of the checkpoint of a fresh tube, with all that makes it safe: checksums,
/// flushing to the disk, checks after reading.
void measure_checkpoint(const Size& size, const StartStates& states, const Effort& effort,
                        Results& results);

/// From settings to the first step done, each time in a process of its own.
void measure_start_up(const Size& size, const Effort& effort, Results& results);

}  // namespace riesel::bench
