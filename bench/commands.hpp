// The subcommands of the suite's program, besides the suite itself: what the suite and the
// comparison with other codes call in processes of their own. Each prints one JSON object.
#pragma once

#include "bench/start_states.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace riesel::bench {

/// Makes a start state if it is missing: its checkpoint, and the model as other codes need it.
void make_state(const StartStates& states, const std::string& case_name, const std::string& size,
                const std::vector<std::string>& overrides);

struct AdvanceOptions {
  std::filesystem::path checkpoint;
  Variant variant;
  std::int64_t warm_up = 0, steps = 1;
};

/// Steps a checkpoint: what it took, what came out, and the memory of the process.
void advance(const AdvanceOptions& options);

/// From the settings of a fresh tube to its first step: what it took, and the memory.
void start_up(const std::string& case_name, const std::string& size, int threads);

/// Threads that do nothing but wait for each other, as they do twice in each step: ns per barrier,
/// in many short spells, as it changes from one second to the next.
void barrier(int threads);

}  // namespace riesel::bench
