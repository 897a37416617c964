// Slices that go askew: several steps with one part of the system while it is in the caches.
//
// Where the grains do not fit into the caches, a step waits for memory, and several steps with one
// part of the system cost little more than one. So large systems are cut into many slices, one
// after the other along the tube. As soon as one has begun a step, the one before it can complete
// that step and begin the next, then the one before that, and so on, while all of them are still in
// the cache. Each slice is at most one step ahead of the next; of two distant slices, one may be
// ahead by as many steps as the candidates hold. The results are the same, as the sums of integers
// do not depend on order.
#pragma once

#include "engine/state.hpp"
#include "engine/team_barrier.hpp"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace riesel {

/// When and how slices go askew. The results do not depend on it.
struct Askew {
  /// Bytes of a slice in plain stepping (more where the box is wide): so few that as many slices as
  /// one may be ahead in steps fit into a part of the last cache. Flights, which touch less of a
  /// slice in a step, have slices twice as large.
  double bytes_of_slice = 0.35e6;
  std::int64_t steps = 12;  ///< by which one slice may be ahead of another
  /// Bytes of the whole system: smaller ones fit into the caches, and do each step together.
  double least_bytes = 30e6;
  /// Contacts per grain: with fewer, flights have one slice for each thread, as a step touches so
  /// little memory that slices only cost.
  double contacts_per_grain = 0.02;

  /// All slices do each step together, whatever memory the system takes.
  static constexpr Askew never() {
    return {.least_bytes = std::numeric_limits<double>::infinity()};
  }

  /// Whether the state takes so much memory that slices go askew, if they can.
  bool pays(const State& state) const;
  /// The steps by which one slice may be ahead of another in this state; 1: all do each together.
  std::int64_t most_steps(const State& state) const;
  /// How many slices each of the threads is to have; 1 if they cannot go askew.
  std::size_t slices_per_thread(const State& state, int threads, bool by_flights) const;
  /// Whether flights with so many contacts gain by going askew. If they do so `now`, somewhat fewer
  /// contacts are enough, so that the answer does not flip back and forth.
  bool flights_gain(std::size_t contacts, std::size_t grains, bool now) const;
};

/// The last step of which a slice has done a certain part, for other threads to see. What its
/// thread has read and written before pass() happened before all that follows, in another thread,
/// a passed() with that step.
class Milestone {
public:
  void pass(std::int64_t step) { step_.store(step, std::memory_order_release); }
  std::int64_t passed() const { return step_.load(std::memory_order_acquire); }

private:
  std::atomic<std::int64_t> step_{0};
};

/// The neighbours of a slice in the ring of all slices.
struct PlaceInRing {
  PlaceInRing(std::size_t slice, std::size_t slices)
      : before(slice == 0 ? slices - 1 : slice - 1), after(slice + 1 == slices ? 0 : slice + 1) {}
  std::size_t before, after;
};

/// One thread's part of steps that go askew: lets its slices, begin ... end - 1, go on until
/// stopped(). go_on(slice) does all that the slice can do now, and returns false if that is
/// nothing. After a slice has gone on, the slices before it are tried again, one after the other.
template <class GoOn, class Stopped>
void go_askew(std::size_t begin, std::size_t end, GoOn go_on, Stopped stopped) {
  Patience patience;
  while (!stopped()) {
    bool any = false;
    for (std::size_t slice = begin; slice < end; ++slice)
      for (std::size_t s = slice; go_on(s); --s) {
        any = true;
        if (s == begin) break;
      }
    if (any)
      patience = {};
    else
      patience.wait_a_moment();
  }
}

}  // namespace riesel
