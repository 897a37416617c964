// Where the threads of a team wait for each other.
//
// A step has several such places, each a few microseconds of work after the last. A waiting thread
// first looks again and again, for about as long as it takes to put a thread to sleep and to wake
// it; then it sleeps and leaves its core to others. So steps stay short where the team has its
// cores to itself, and a busy machine costs no more than its share: OpenMP's own barrier, which
// looks for milliseconds, takes the core from the very thread that it waits for, and asks the
// system to wake sleepers each time, even in a team of one; std::barrier sleeps too soon.
#pragma once

#include "engine/aligned.hpp"

#include <atomic>
#include <cstddef>
#include <cstdint>

namespace riesel {

/// Tells the core that this is a loop of waiting.
inline void pause_core() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  __asm__ __volatile__("yield");
#endif
}

/// Has a cache line for itself.
class alignas(cache_line) TeamBarrier {
public:
  /// So often one looks before it leaves the core to others: 5 to 20 microseconds.
  static constexpr int looks = 500;

  explicit TeamBarrier(int members) : members_(members) {}

  std::size_t members() const { return static_cast<std::size_t>(members_); }

  /// Returns when all members have called it as often as this one. What each did before is seen by
  /// all afterwards.
  void arrive_and_wait() {
    if (members_ == 1) return;
    const std::uint32_t passed = passed_.load(std::memory_order_relaxed);
    if (arrived_.fetch_add(1, std::memory_order_acq_rel) + 1 == members_) {
      arrived_.store(0, std::memory_order_relaxed);
      // In one order with the count of sleepers that notify_all() looks at: none is overlooked.
      passed_.store(passed + 1, std::memory_order_seq_cst);
      passed_.notify_all();
      return;
    }
    for (int look = 0; look < looks; ++look) {
      if (passed_.load(std::memory_order_acquire) != passed) return;
      pause_core();
    }
    passed_.wait(passed, std::memory_order_acquire);
  }

private:
  const int members_;
  std::atomic<int> arrived_{0};
  std::atomic<std::uint32_t> passed_{0};  // how often all were there; may wrap
};

}  // namespace riesel
