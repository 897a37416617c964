// Plain stepping: all grains in each step, the leapfrog form of velocity Verlet.
//
// A slice does a step in three parts. It moves: velocities take up the last kicks, positions go on.
// It touches: contacts are looked for and give their kicks. It receives: the kicks reach its
// grains. To touch it needs the positions of its neighbours, to receive their kicks.
//
// Each thread has one slice, and all do each part together, where the grains fit into the caches.
// Where they do not, a step waits for memory, and several steps with one part of the system cost
// little more than one. So many grains have many slices, one after the other along the tube, and
// these go askew: as soon as one has moved, the one before it can touch, receive and move to the
// next step, then the one before that, and so on, while all of them are still in the cache. So each
// slice is at most one step ahead of the next, and any of any other by as many steps as the
// candidates hold. The results are the same, as the sums of integers do not depend on order.
#pragma once

#include "engine/aligned.hpp"
#include "engine/candidates.hpp"
#include "engine/contact_law.hpp"
#include "engine/encounter.hpp"
#include "engine/state.hpp"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace riesel {

/// How slices go askew. The results do not depend on it.
struct Askew {
  /// Grains of a slice, or more where the box is wide: so few that as many slices as there are
  /// steps between the first and the last fit into a part of the last cache.
  std::size_t slice = 4000;
  std::int64_t steps = 16;  ///< that one slice is ahead of another at most
  /// With fewer grains all slices do each step together: they fit into the caches as they are.
  std::size_t fewest = 200'000;

  /// That one slice may be ahead of another in this state; 1: all do each step together.
  std::int64_t most_steps(const State& state) const;
  /// How many slices each of the threads is to have: one if they cannot go askew.
  std::size_t slices_per_thread(const State& state, int threads) const;
};

class PlainSteps {
public:
  /// Nobody else steps with the candidates afterwards. Keeps references.
  PlainSteps(State& state, const ContactModel& model, Candidates& candidates, const Askew& askew);

  /// From step `now`, that of the state, to `last`, or until the run cannot go on: then perhaps
  /// some steps beyond the trouble. To be called by all threads of a team with the same steps;
  /// `number` is that of the thread.
  void advance(std::size_t number, std::int64_t now, std::int64_t last);

private:
  /// How far a slice is that goes askew; on a cache line of its own.
  struct alignas(cache_line) Progress {
    std::atomic<std::int64_t> moved, touched;
    bool done;
  };

  /// What a thread works with.
  struct Member {
    std::span<Slice> share;
    StepUnits units;
    Profile& profile;
  };

  void move(Member& member, Slice& mine, std::int64_t step);
  void touch(Member& member, Slice& mine, std::int64_t step, double motion);
  void receive(Member& member, Slice& mine, std::span<const Slice> givers);
  void step_together(Member& member, std::int64_t step);
  void step_askew(Member& member, std::int64_t first, std::int64_t last);
  bool go_on(Member& member, std::size_t slice, std::int64_t last);

  State& state_;
  const ContactModel& model_;
  Candidates& candidates_;
  const StepUnits units_;  // of some step; each member has a copy
  const std::int64_t most_steps_askew_;
  CoarsePositions coarse_;  // of all grains
  std::vector<Progress> progress_;
};

}  // namespace riesel
