// Plain stepping: all grains in each step, the leapfrog form of velocity Verlet.
//
// A slice does a step in three parts, named as the functions are. It moves: positions change by the
// velocities. It touches: beginning contacts are found, and all contacts give their kicks. It
// receives: the kicks are added to the velocities of its grains. To touch it needs the positions of
// its neighbours, to receive their kicks.
//
// Where the grains fit into the caches, each thread has one slice, and all slices do each part
// together. Where they do not, each thread has many slices, which go askew (Askew).
#pragma once

#include "engine/aligned.hpp"
#include "engine/askew.hpp"
#include "engine/candidates.hpp"
#include "engine/contact_law.hpp"
#include "engine/encounter.hpp"
#include "engine/state.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace riesel {

class PlainSteps {
public:
  /// Keeps references. Nothing else may step with these candidates.
  PlainSteps(State& state, const ContactModel& model, Candidates& candidates, const Askew& askew);

  /// To be called after Candidates::start_from().
  void start_over();

  /// Steps the state from step `now`, which must be its own, to `last`, or until the run cannot go
  /// on: then it may be some steps beyond the trouble. To be called by all threads of the team with
  /// the same steps; `number` is that of the thread.
  void advance(std::size_t number, std::int64_t now, std::int64_t last);

private:
  /// The last step of which a slice that goes askew has done each part; on a cache line of its own.
  struct alignas(cache_line) Progress {
    Milestone moved, touched;
    std::int64_t received;
  };

  /// What a thread works with.
  struct Member {
    std::size_t number;
    std::span<Slice> share;
    StepUnits units;
    Profile& profile;
  };

  void move(Member& member, Slice& mine, std::int64_t step);
  void touch(Member& member, Slice& mine, std::int64_t step, double motion);
  void receive(Member& member, Slice& mine, std::span<const Slice> givers);
  void step_together(Member& member, std::int64_t step);
  std::int64_t steps_ahead(Member& member, std::int64_t now, std::int64_t last);
  std::int64_t begin_together(Member& member, std::int64_t now, std::int64_t last);
  void step_askew(Member& member, std::int64_t now, std::int64_t moved, std::int64_t last);
  bool go_on(Member& member, std::size_t slice, std::int64_t last);

  State& state_;
  const ContactModel& model_;
  Candidates& candidates_;
  const StepUnits units_;  // each member has a copy, which follows its steps
  const std::int64_t most_steps_askew_;
  PackedPositions coarse_;  // of all grains
  std::vector<Progress> progress_;
};

}  // namespace riesel
