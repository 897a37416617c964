// Calls of the system that signals may interrupt, on network file systems even open() and fsync().
#pragma once

#include <cerrno>

namespace riesel::io {

/// What call() returns when no signal has interrupted it: a number that is negative, with errno, if
/// it failed.
template <class Call>
auto uninterrupted(Call call) {
  for (;;)
    if (const auto result = call(); result >= 0 || errno != EINTR) return result;
}

}  // namespace riesel::io
