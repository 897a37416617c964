// Rows of the ensemble: many small runs of one thread each, by `riesel sweep` as a user starts it,
// one after the other and as many at once as there are cores.
#pragma once

#include "bench/flow_rows.hpp"

#include <filesystem>

namespace riesel::bench {

/// The same seeds of a fresh tube with `--jobs 1` and `--jobs 2`, start-up, estimates and output
/// included, in a folder of their own below `folder`. `riesel` is the command.
void measure_ensemble(const std::filesystem::path& riesel, const std::filesystem::path& folder,
                      const Effort& effort, Results& results);

}  // namespace riesel::bench
