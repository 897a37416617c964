// Slices that go askew: several steps with one part of the system while it is in the caches.
//
// Where the grains do not fit into the caches a step waits for memory, and several steps with one
// part of the system cost little more than one. So many grains have many slices, one after the
// other along the tube. As soon as one has begun a step, the one before it can complete it and
// begin the next, then the one before that, and so on, while all of them are still in the cache. So
// each slice is at most one step ahead of the next, and any of any other by as many steps as the
// candidates hold. The results are the same, as the sums of integers do not depend on order.
#pragma once

#include "engine/state.hpp"
#include "engine/team_barrier.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>

namespace riesel {

/// How slices go askew. The results do not depend on it.
struct Askew {
  /// Bytes of a slice in plain stepping, or more where the box is wide: so few that as many slices
  /// as there are steps between the first and the last fit into a part of the last cache. Flights,
  /// which touch less of a slice in a step, have slices twice as large.
  double slice = 0.35e6;
  std::int64_t steps = 12;  ///< that one slice is ahead of another at most
  /// Bytes: what takes less fits into the caches as it is, and all slices do each step together.
  double least = 30e6;
  /// Flights, with fewer contacts per grain, have one slice for each thread: so little memory is
  /// touched in a step then that it does not matter where it is, and slices only cost.
  double contacts = 0.02;

  /// All slices do each step together, whatever it takes.
  static constexpr Askew never() { return {.least = std::numeric_limits<double>::infinity()}; }

  /// Whether the state takes so much memory that slices go askew, if they can.
  bool pays(const State& state) const;
  /// That one slice may be ahead of another in this state; 1: all do each step together.
  std::int64_t most_steps(const State& state) const;
  /// How many slices each of the threads is to have: one if they cannot go askew.
  std::size_t slices_per_thread(const State& state, int threads, bool by_flights) const;
  /// Whether flights with so many contacts gain by it. If they go askew `now`, somewhat fewer are
  /// enough, so that it is not now one, now the other.
  bool flights_gain(std::size_t contact_count, std::size_t grains, bool now) const;
};

/// Where a slice is in the ring of all.
struct PlaceInRing {
  PlaceInRing(std::size_t slice, std::size_t slices)
      : before(slice == 0 ? slices - 1 : slice - 1), after(slice + 1 == slices ? 0 : slice + 1) {}
  std::size_t before, after;
};

/// One thread's part of the steps of a team: lets its slices, begin ... end - 1, go on until
/// stopped(). go_on(slice) does what the slice can do now, and returns false if that is nothing.
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
