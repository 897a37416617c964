// How the threads of a team wait for each other.
//
// A step has several places for that, each a few microseconds of work after the last. A waiting
// thread first looks again and again; later it offers its core to others between two looks. So
// steps stay short where the team has its cores to itself, and a busy machine costs no more than
// its share: OpenMP's own barrier, which looks for milliseconds, takes the core from the very
// thread that it waits for, and asks the system to wake sleepers each time, even in a team of one;
// std::barrier sleeps too soon. Nobody sleeps here: then the others would have to look who does,
// each time.
#pragma once

#include "engine/aligned.hpp"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <thread>
#include <vector>

namespace riesel {

/// Tells the core that this is a loop of waiting.
inline void pause_core() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  __asm__ __volatile__("yield");
#endif
}

/// One thread's waiting for something that is about to happen.
class Patience {
public:
  /// To be called between two looks.
  void wait_a_moment() {
    if (moments_ == most) {
      std::this_thread::yield();
    } else {
      pause_core();
      ++moments_;
    }
  }

private:
  static constexpr int most = 500;  // 5 to 20 microseconds, and then others may have the core
  int moments_ = 0;
};

class TeamBarrier {
public:
  explicit TeamBarrier(int members) : arrivals_(static_cast<std::size_t>(members)) {}

  std::size_t members() const { return arrivals_.size(); }

  /// Returns when all members, 0, 1, ..., have arrived as often as this one. What each did before
  /// it arrived is seen by all afterwards.
  void arrive_and_wait(std::size_t member) {
    arrive(member);
    wait(member);
  }

  /// The two halves of it, to be called in turn. Meanwhile others may be anywhere between their
  /// last arrival and their next: what a member does between the halves must not touch what they
  /// use. So it has something to do while news goes from core to core.
  void arrive(std::size_t member) {
    if (members() == 1) return;
    std::atomic<std::uint32_t>& mine = arrivals_[member].count;
    mine.store(mine.load(std::memory_order_relaxed) + 1, std::memory_order_release);
  }
  void wait(std::size_t member) {
    if (members() == 1) return;
    const std::uint32_t before = arrivals_[member].count.load(std::memory_order_relaxed) - 1;
    for (const Arrivals& other : arrivals_) wait_for_more(other, before);
  }

private:
  /// How often one member has come; may wrap. It alone writes to it, so that a look of another
  /// takes the cache line from core to core once, where a count of all goes back and forth. Two
  /// lines: processors fetch them in pairs.
  struct alignas(2 * cache_line) Arrivals {
    std::atomic<std::uint32_t> count{0};
  };

  /// Nobody is ahead of another by more than one arrival.
  static void wait_for_more(const Arrivals& other, std::uint32_t before) {
    for (Patience patience; other.count.load(std::memory_order_acquire) == before;)
      patience.wait_a_moment();
  }

  std::vector<Arrivals> arrivals_;
};

}  // namespace riesel
