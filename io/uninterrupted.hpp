// System calls that signals may interrupt; on network file systems even open() and fsync().
#pragma once

#include <cerrno>

namespace riesel::io {

/// Repeats call() until no signal interrupts it, and returns its result: a number that is negative,
/// with errno set, if it failed.
template <class Call>
auto uninterrupted(Call call) {
  for (;;)
    if (const auto result = call(); result >= 0 || errno != EINTR) return result;
}

}  // namespace riesel::io
