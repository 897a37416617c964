// Stepping at the cost of the contacts, not of the grains.
//
// In rapid flow nearly all grains are in free flight, which the integer kinematics crosses exactly
// in any number of steps at once. So only the grains that take part in a contact are stepped. The
// others stand in the store with the step of their last touch, and each candidate (a pair, or a
// grain near a wall) has an appointment: the step before which it cannot touch as long as the
// grains keep to their courses. In that step it is looked at, and either a contact begins or a new
// appointment is made.
//
// A grain in contact leaves its course. Most appointments are made with a tolerance: they hold as
// long as both grains stay that close to their courses, in contact or not. Those of pairs that are
// too close for that are exact, and made anew when one of the two is deflected; closer than a
// deflected grain may stray, a pair is watched in every step (CloseWatch). A grain that goes
// beyond the tolerance, or whose last contact ends, gets a new course and new appointments. So no
// contact is missed, and the steps done here are the same, bit by bit, as those of plain stepping.
//
// Each slice of the candidates has a region, stepped by one thread. All regions do the same step;
// what they tell each other is in border.hpp.
//
// See docs/performance-log.md for the figures and docs/architecture.md for how this compares with
// fixed windows.
#pragma once

#include "engine/candidates.hpp"
#include "engine/contact_law.hpp"
#include "engine/flight_region.hpp"
#include "engine/state.hpp"

#include <cstddef>
#include <cstdint>
#include <deque>

namespace riesel {

class Flights {
public:
  /// A skin that serves flights, as a part of the mean diameter: pairs far apart cost no more than
  /// an appointment.
  static constexpr double skin_per_diameter = 0.65;

  /// Nobody else uses the candidates afterwards. Keeps references.
  Flights(State& state, const ContactModel& model, Candidates& candidates)
      : airspace_(state, model, candidates) {
    for (std::size_t slice = 0; slice < candidates.slices().size(); ++slice)
      regions_.emplace_back(airspace_, slice);
  }

  // All that follows is to be called by all threads of a team, one for each slice, with the same
  // step; `member` is the slice of the thread. What returns a bool tells all the same: false if
  // the run cannot go on.

  /// To be called before the first step(), and between land() and the next. All grains are at this
  /// step. From here to land() the store is no state.
  bool take_off(std::size_t member, std::int64_t step) { return regions_[member].take_off(step); }
  /// One step, to this one, of all that does not fly.
  bool step(std::size_t member, std::int64_t step) { return regions_[member].step(step); }
  /// Brings all grains to this step, which must be that of the last step().
  void land(std::size_t member, std::int64_t step) { regions_[member].land(step); }

private:
  Airspace airspace_;
  std::deque<FlightRegion> regions_;  // which never move
};

}  // namespace riesel
