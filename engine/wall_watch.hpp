// Looks at the contacts with walls that have ended: judges them as brakes, and puts them together
// to visits.
//
// Done between two advances, for all threads together: the contacts are few, they must be seen in
// the order of their times, and it takes masses and the contact law, which a thread that ends a
// contact does not have at hand.
#pragma once

#include "engine/contact_law.hpp"
#include "engine/state.hpp"

#include <vector>

namespace riesel {

class WallWatch {
public:
  WallWatch(const State& state, const ContactModel& model);

  /// Takes up what has ended since the last look, and closes the visits to which no contact can
  /// come any more. `state` is complete: contacts and tally are those of its step.
  void look(State& state) const;

private:
  void take_up(State& state) const;
  void close_visits(State& state) const;
  double mass(const Contact& contact) const;

  ContactModel model_;
  std::vector<double> mass_;  // kg, by id
};

}  // namespace riesel
