// Stepping at the cost of the contacts, not of the grains.
//
// In rapid flow nearly all grains are in free flight, which the integer kinematics crosses exactly
// in any number of steps at once. So only the grains that take part in a contact are stepped. The
// others stand in the store with their course, and each candidate (a pair, or a grain near a wall)
// has an appointment: the step before which it cannot touch as long as the grains keep to their
// courses. In that step it is looked at, and either a contact begins or a new appointment is made.
//
// A grain in contact leaves its course. Most appointments are made with a tolerance: they hold as
// long as both grains stay that close to their courses, in contact or not. Those of pairs that are
// too close for that are exact, and made anew when one of the two is deflected. A pair closer than
// a deflected grain may be off its course is watched in every step (CloseWatch). A grain that goes
// beyond the tolerance, or whose last contact ends, gets a new course and new appointments. So no
// contact is missed, and the results are the same, bit by bit, as those of plain stepping.
//
// Each slice of the candidates has a region, stepped by one thread. Where the grains fit into the
// caches, each thread has one region, and all do the same step; else it has many, which go askew
// (Askew). What regions tell each other is in border.hpp.
//
// "Take off" means that the store changes from a State to courses, "land" that it changes back. See
// docs/performance-log.md for measurements, and docs/architecture.md for a comparison with fixed
// windows.
#pragma once

#include "engine/aligned.hpp"
#include "engine/askew.hpp"
#include "engine/candidates.hpp"
#include "engine/contact_law.hpp"
#include "engine/flight_region.hpp"
#include "engine/state.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace riesel {

class Flights {
public:
  /// A wider skin than in plain stepping: pairs far apart cost no more than an appointment.
  static constexpr Candidates::Purpose purpose{.skin_per_diameter = 0.65, .searched = false};

  /// Keeps references. Nothing else may step with these candidates.
  Flights(State& state, const ContactModel& model, Candidates& candidates, const Askew& askew);

  /// To be called after Candidates::start_from().
  void start_over();

  /// Steps the state from step `now`, which must be its own, to `last`, or until another number of
  /// slices is better (Askew), or until the run cannot go on: then it may be some steps beyond the
  /// trouble. To be called by all threads of the team with the same steps; `number` is that of the
  /// thread.
  void advance(std::size_t number, std::int64_t now, std::int64_t last);

private:
  /// What a thread works with: regions begin ... end - 1.
  struct alignas(cache_line) Member {
    std::size_t number;
    std::size_t begin, end;
    std::span<Slice> share;  // theirs
    Profile& profile;
    std::int64_t hold_until = 0;  // step until which the candidates of all slices hold for sure
    double fastest2 = 0.0;        // (m per step)^2 relative to the drift, of any grain
    bool trouble = false;         // in any slice: the run cannot go on
    bool under_way = false;       // appointments are made: the next take-off goes on with them
    bool ill_cut = false;         // another number of slices is better
    Leeway leeway = {};           // since the candidates were listed

    /// Does what one of the threads has to do for all.
    bool leads() const { return number == 0; }
  };

  /// The last step that a slice that goes askew has done each part of; on a cache line of its own.
  struct alignas(cache_line) Progress {
    Milestone collided, settled;
    std::int64_t foreseen;
    bool fetched;
  };

  void take_off(Member& member, std::int64_t step);
  void begin(Member& member, std::int64_t step, FlightRegion::Kicks kicks);
  void land(Member& member, std::int64_t step);
  void renew(Member& member, std::int64_t step);
  void heed(Member& member) const;
  bool ill_cut() const;
  void step_together(Member& member, std::int64_t step);
  std::int64_t steps_askew(const Member& member, std::int64_t now, std::int64_t last) const;
  void step_askew(Member& member, std::int64_t now, std::int64_t last);
  bool go_on(const Member& member, std::size_t slice, std::int64_t last);

  template <class Do>
  void for_each_region(const Member& member, Do something);
  void wait(const Member& member) { airspace_.candidates.team().arrive_and_wait(member.number); }
  template <class Do>
  void wait_and_meanwhile(const Member& member, Do something);

  Airspace airspace_;
  const Askew askew_;
  const std::int64_t most_steps_askew_;
  const bool may_go_askew_;  // the threads have several slices each, or may get them
  std::vector<std::unique_ptr<FlightRegion>> regions_;
  std::vector<Member> members_;
  std::vector<Progress> progress_;  // of regions
};

}  // namespace riesel
