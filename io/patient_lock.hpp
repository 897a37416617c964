#pragma once

#include <chrono>

namespace riesel::io {

/// Asks for the lock of an open file (flock) until nobody else has it, for `patience` at most.
/// False, with errno, if it was not to be had: EWOULDBLOCK if another process has it.
bool lock_patiently(int descriptor, std::chrono::milliseconds patience);

}  // namespace riesel::io
