// The machine on which the suite runs: what it is, how much it does besides, and how fast it moves
// memory.
#pragma once

#include "bench/timing.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace riesel::bench {

struct Cache {
  int level;
  std::string kind;  ///< "Data", "Instruction", "Unified"
  std::size_t bytes;
};

struct Machine {
  std::string cpu;  ///< model name
  int cores;        ///< processors that this process may use
  std::vector<Cache> caches;
  std::size_t memory;                  ///< bytes
  std::array<double, 3> load_average;  ///< of the last 1, 5 and 15 minutes, at the moment of asking

  /// Lower-case letters, digits and hyphens: for the names of files.
  std::string name() const;
};

/// What the system tells; what it does not is "unknown" or zero.
Machine this_machine();

/// The triad a = b + s c over three arrays that together take `working_set` bytes, by `threads`
/// threads.
struct Bandwidth {
  int threads;
  std::size_t working_set;  ///< bytes
  Timing timing;            ///< of one pass

  /// A written line is read before it is written (the stores are ordinary ones): four transfers.
  double bytes_per_second() const {
    return static_cast<double>(working_set) / 3.0 * 4.0 / timing.least();
  }
};

/// In turns for one and two threads.
std::vector<Bandwidth> measure_bandwidth(std::size_t working_set, int repetitions);

}  // namespace riesel::bench
