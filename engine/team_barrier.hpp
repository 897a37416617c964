// How the threads of a team wait for each other.
//
// A step has several barriers, a few microseconds of work apart. A waiting thread first spins, and
// after a while yields its core between two looks. So steps stay short where the team has its cores
// to itself, and on a busy machine it loses no more than its share. OpenMP's own barrier spins for
// milliseconds, which may take the core from the very thread that it waits for, and makes a system
// call to wake sleepers each time, even in a team of one; std::barrier sleeps too soon. Here no
// thread sleeps, so that none has to check for sleepers.
#pragma once

#include "engine/aligned.hpp"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <thread>
#include <vector>

namespace riesel {

/// Tells the processor that this is a spin loop.
inline void pause_core() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  __asm__ __volatile__("yield");
#endif
}

/// The wait of one thread for something that is about to happen: first spins, then yields.
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
  static constexpr int most = 500;  // pauses before it yields: 5 to 20 microseconds
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

  /// The two halves of arrive_and_wait(), to be called in turn. Between them a member can do work
  /// while the news of its arrival goes from core to core. That work must not touch what others
  /// use: they may be anywhere between their last arrival and their next.
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
  /// How often one member has arrived; may wrap. Only this member writes to it, so that the cache
  /// line goes to each other core once, whereas that of a common counter would go back and forth.
  /// Takes two lines because processors fetch lines in pairs.
  struct alignas(2 * cache_line) Arrivals {
    std::atomic<std::uint32_t> count{0};
  };

  /// No member can be ahead of another by more than one arrival, so that != means "more".
  static void wait_for_more(const Arrivals& other, std::uint32_t before) {
    for (Patience patience; other.count.load(std::memory_order_acquire) == before;)
      patience.wait_a_moment();
  }

  std::vector<Arrivals> arrivals_;
};

}  // namespace riesel
