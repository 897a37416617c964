#include "bench/memory.hpp"

#include <cstdlib>
#include <fstream>
#include <string>

namespace riesel::bench {

Memory memory_of_this_process() {
  Memory memory{};
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);) {
    const auto bytes = [&] {
      return 1024 * static_cast<std::size_t>(std::strtoull(line.c_str() + 6, nullptr, 10));
    };
    if (line.starts_with("VmRSS:")) memory.resident = bytes();
    if (line.starts_with("VmHWM:")) memory.peak = bytes();
  }
  return memory;
}

}  // namespace riesel::bench
