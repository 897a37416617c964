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
// too close for that are exact, and made anew when one of the two is deflected; closer than a
// deflected grain may stray, a pair is watched in every step (CloseWatch). A grain that goes
// beyond the tolerance, or whose last contact ends, gets a new course and new appointments. So no
// contact is missed, and the steps done here are the same, bit by bit, as those of plain stepping.
//
// Each slice of the candidates has a region, stepped by one thread. Each thread has one, and all do
// the same step, where the grains fit into the caches; else it has many, which go askew (Askew).
// What regions tell each other is in border.hpp.
//
// See docs/performance-log.md for the figures and docs/architecture.md for how this compares with
// fixed windows.
#pragma once

#include "engine/aligned.hpp"
#include "engine/askew.hpp"
#include "engine/candidates.hpp"
#include "engine/contact_law.hpp"
#include "engine/flight_region.hpp"
#include "engine/state.hpp"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace riesel {

class Flights {
public:
  /// Pairs far apart cost no more than an appointment.
  static constexpr Candidates::Purpose purpose{.skin_per_diameter = 0.65, .searched = false};

  /// Nobody else uses the candidates afterwards. Keeps references.
  Flights(State& state, const ContactModel& model, Candidates& candidates, const Askew& askew);

  /// The candidates have started from another state.
  void start_over();

  /// From step `now`, that of the state, to `last`, or until the slices should be others (Askew),
  /// or until the run cannot go on: then perhaps some steps beyond the trouble. To be called by all
  /// threads of a team with the same steps; `number` is that of the thread.
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
    bool trouble = false;         // of any slice
    bool under_way = false;       // appointments are made
    bool ill_cut = false;         // the slices should be others
    Leeway leeway = {};           // since they were
  };

  /// The last step that a slice that goes askew has done each part of; on a cache line of its own.
  struct alignas(cache_line) Progress {
    std::atomic<std::int64_t> collided, settled;
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
  std::int64_t steps_askew(Member& member, std::int64_t now, std::int64_t last) const;
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
  const bool may_go_askew_;  // all threads have several slices, or may have
  std::vector<std::unique_ptr<FlightRegion>> regions_;
  std::vector<Member> members_;
  std::vector<Progress> progress_;  // of regions
};

}  // namespace riesel
