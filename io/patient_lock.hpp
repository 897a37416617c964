#pragma once

#include <chrono>

namespace riesel::io {

/// Tries to lock an open file (flock) until it succeeds, for at most `patience`. False, with errno
/// set, if it does not: EWOULDBLOCK if another process holds the lock.
bool lock_patiently(int descriptor, std::chrono::milliseconds patience);

}  // namespace riesel::io
