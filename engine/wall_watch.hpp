// Evaluates the contacts with walls that have ended: judges them as brakes, and joins them to
// visits.
//
// Done between two advances, by one thread: the contacts are few, those of one visit may have ended
// in several threads, and masses and the contact law are needed, which are not at hand where a
// contact ends.
#pragma once

#include "engine/contact_law.hpp"
#include "engine/state.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace riesel {

class WallWatch {
public:
  WallWatch(const State& state, const ContactModel& model);

  /// Evaluates the contacts that have ended since the last call (StepTally::ended_at_walls), and
  /// counts the visits that no further contact can join. The contacts and the tally of `state` must
  /// be those of its step.
  void look(State& state) const;

private:
  void take_up(State& state) const;
  void join_and_close(State& state) const;
  void close(State& state, const WallVisit& visit) const;
  double mass(std::int32_t grain) const { return mass_[static_cast<std::size_t>(grain)]; }

  ContactModel model_;
  std::vector<double> mass_;  // kg, by id
};

}  // namespace riesel
