// How much memory this process has.
#pragma once

#include <cstddef>

namespace riesel::bench {

struct Memory {
  std::size_t resident;  ///< bytes, now
  std::size_t peak;      ///< bytes, the most that was resident so far
};

/// Of this process, as Linux tells in /proc/self/status; zeros elsewhere.
Memory memory_of_this_process();

}  // namespace riesel::bench
