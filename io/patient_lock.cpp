#include "io/patient_lock.hpp"

#include <sys/file.h>

#include <cerrno>
#include <thread>

namespace riesel::io {

bool lock_patiently(int descriptor, std::chrono::milliseconds patience) {
  using Clock = std::chrono::steady_clock;
  constexpr auto pause = std::chrono::milliseconds(1);
  const auto last = Clock::now() + patience;
  while (true) {
    if (flock(descriptor, LOCK_EX | LOCK_NB) == 0) return true;
    if (errno != EWOULDBLOCK || Clock::now() >= last) return false;
    std::this_thread::sleep_for(pause);
  }
}

}  // namespace riesel::io
