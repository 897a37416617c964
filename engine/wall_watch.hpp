// Looks at the contacts with walls that have ended: judges them as brakes, and puts them together
// to visits.
//
// Done between two advances, for all threads together: the contacts are few, those of one visit may
// have ended in several threads, and it takes masses and the contact law, which a thread that ends
// a contact does not have at hand.
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

  /// Takes up what has ended since the last look, and closes the visits to which no contact can
  /// come any more. `state` is complete: its lasting contacts and its tally are those of its step.
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
