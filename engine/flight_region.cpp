#include "engine/flight_region.hpp"

#include "engine/contact_loop.hpp"
#include "engine/encounter.hpp"

#include <algorithm>
#include <cmath>

namespace riesel {

namespace {

/// The tolerance is what the fastest grain goes in this many steps, as faster grains leave their
/// courses farther in a contact; clamped to these parts of the mean diameter. A larger one means
/// fewer new courses, but more neighbours to be looked at in every step.
constexpr double steps_of_fastest = 4.0, least_per_diameter = 0.0002, most_per_diameter = 0.004;

double fastest_shaking(const State& state) {
  double most = 0.0;
  for (const WallLattice& wall : state.walls)
    most = std::max(most, wall.motion.fastest_oscillation() * state.time_step);
  return most;
}

}  // namespace

Airspace::Airspace(State& the_state, const ContactModel& the_model, Candidates& the_candidates)
    : state(the_state),
      model(the_model),
      candidates(the_candidates),
      courses(the_state),
      announcements(the_candidates.slices().size()),
      diameter(mean_diameter(the_state.grains)),
      shaking(fastest_shaking(the_state)) {}

Leeway Airspace::leeway() const {
  const double tolerance = std::clamp(steps_of_fastest * candidates.fastest(),
                                      least_per_diameter * diameter, most_per_diameter * diameter);
  const double along = tolerance * std::sqrt(0.5);
  return {.tolerance = tolerance,
          .x = nearest_fixed(along / state.box.quantum_x()),
          .y = nearest_fixed(along / state.box.quantum_y()),
          .room = room_in_skin(state.box, candidates.skin(), tolerance)};
}

FlightRegion::FlightRegion(Airspace& airspace, std::size_t index, Profile& profile)
    : airspace_(airspace),
      slice_(airspace.candidates.slices()[index]),
      units_(airspace.state),
      border_(slice_, airspace.courses, airspace.announcements, index),
      deflected_(airspace.state.grains.inertia),
      skin_guard_(airspace.state, airspace.candidates, airspace.courses),
      appointments_(airspace.state, slice_, airspace.courses, border_),
      profile_(profile) {}

void FlightRegion::start_over(std::int64_t step, const Leeway& leeway) {
  leeway_ = leeway;
  units_.move_to(step);
  airspace_.courses.start_over(SlotRange{slice_.begin, slice_.end});
  deflected_.clear();
  guests_.clear();
  let_go_.clear();
  border_.find_neighbours(airspace_.candidates.slices_are_thick());
  border_.list_foreign();
  appointments_.start_over(leeway.tolerance);
}

/// Grains with a last kick are taken up even without a contact: the kick may not be in their
/// velocity yet.
void FlightRegion::take_up_contacts(std::int64_t step) {
  border_.list_border();
  const Grains& g = airspace_.state.grains;
  for (const std::uint32_t slot : slice_.kicked) {
    const BodyKick by{g.kick[slot], g.spin_kick_of(slot)};
    deflected_.add_kick(deflect(slot, step), by);
  }
  give_up(slice_.kicked);  // from now on the deflected grains have the kicks
  for (LiveContacts* contacts : {&slice_.pair_contacts, &slice_.wall_contacts})
    for (std::size_t i = 0; i < contacts->size(); ++i) take_up(*contacts, i, step);
}

void FlightRegion::set_out(std::int64_t step, Kicks kicks) {
  suffer(step);
  border_.mine().contacts = slice_.pair_contacts.size() + slice_.wall_contacts.size();
  skin_guard_.start_over({slice_.begin, slice_.end}, leeway_.room);
  for (DeflectedGrains::Place place = 0; place < deflected_.end(); ++place) {
    if (is_guest(place)) continue;
    set_course(place, step, kicks);
    if (deflected_.contacts(place) == 0) let_go_.add(place);
  }
  announce(step);
}

void FlightRegion::make_all_appointments(std::int64_t step, std::int64_t earliest,
                                         std::int64_t hold_until) {
  border_.mine().deeds.clear();
  appointments_.make_all(step, earliest, hold_until);
}

void FlightRegion::set_out_again(std::int64_t step) {
  units_.move_to(step);
  border_.mine().new_courses.clear();
  for (DeflectedGrains::Place place = 0; place < deflected_.end(); ++place)
    if (deflected_.in_use(place) && !is_guest(place)) set_course(place, step);
  announce(step);
}

void FlightRegion::move(std::int64_t step) {
  units_.move_to(step);
  deflected_.move(units_.fallen);
  profile_.done(Profile::Phase::fly);
}

void FlightRegion::collide(std::int64_t step) {
  keep_appointments(step);
  profile_.done(Profile::Phase::search);
  step_contacts(step);
}

/// Lets a grain of which a contact has ended fly on, if it has no other contact.
inline void FlightRegion::let_fly(DeflectedGrains::Place place, std::int64_t step) {
  if (!deflected_.in_use(place) || deflected_.contacts(place) > 0) return;
  if (!is_guest(place)) set_course(place, step);
  release(place);
}

void FlightRegion::settle(std::int64_t step) {
  suffer(step);
  profile_.done(Profile::Phase::forces);
  for (const DeflectedGrains::Place place : let_go_.items()) let_fly(place, step);
  let_go_.clear();
  correct_courses(step);
  announce(step);
}

void FlightRegion::settle_inside(std::int64_t step) {
  profile_.done(Profile::Phase::forces);
  let_go_.keep_if([&](DeflectedGrains::Place place) {
    if (at_border(place)) return true;  // other slices may have kicks for it
    let_fly(place, step);
    return false;
  });
  profile_.done(Profile::Phase::appointments);
}

void FlightRegion::foresee(std::int64_t step, std::int64_t hold_until) {
  border_.mine().deeds.clear();
  border_.for_each_after([&](const Announcement& other) {
    for (const std::uint32_t slot : other.new_courses)
      if (border_.is_foreign(slot)) appointments_.reconsider(slot);
  });
  appointments_.make(step, step + 1, hold_until);
}

void FlightRegion::foresee_inside(std::int64_t step, std::int64_t hold_until) {
  appointments_.make_inside(step, step + 1, hold_until);
}

void FlightRegion::fetch() const {
  const std::size_t begin = slice_.begin, count = slice_.end - slice_.begin;
  const auto own = [&](const auto& column) { return std::span(column).subspan(begin, count); };
  const Grains& g = airspace_.state.grains;
  const CoarsePositions& then = airspace_.candidates.when_sorted();
  for (const auto* column : {&g.position, &g.u}) riesel::fetch(own(*column));
  for (const auto* column : {&then.x, &then.y}) riesel::fetch(own(*column));
  riesel::fetch(own(g.radius));
  riesel::fetch(own(airspace_.courses.places()));
  for (const auto* column : {&slice_.pairs.first, &slice_.pairs.second})
    riesel::fetch(std::span(*column));
  appointments_.fetch();
}

void FlightRegion::land(std::int64_t step) {
  for (std::size_t i = slice_.begin; i < slice_.end; ++i) {
    const auto slot = static_cast<std::uint32_t>(i);
    const std::int32_t place = airspace_.courses.place(slot);
    airspace_.courses.put(slot,
                          place == Courses::flying
                              ? airspace_.courses.motion(slot, step)
                              : deflected_.motion(static_cast<DeflectedGrains::Place>(place)));
  }
}

void FlightRegion::need_candidates_until(std::int64_t step) {
  needed_until_ = step;
  border_.mine().strays.clear();
}

inline FixedVector FlightRegion::position(std::uint32_t slot, std::int64_t step) const {
  const Courses& courses = airspace_.courses;
  const std::int32_t place = courses.place(slot);
  return place == Courses::flying ? courses.position(slot, step) : deflected_.position(place);
}

/// Looks at the candidates that are due, and begins the contacts of those that touch.
void FlightRegion::keep_appointments(std::int64_t step) {
  appointments_.keep(
      step, units_, deflected_, [&](std::uint32_t pair) { look_at_pair(pair, step); },
      [&](std::uint32_t near_wall) { look_at_near_wall(near_wall, step); });
}

void FlightRegion::look_at_pair(std::uint32_t pair, std::int64_t step) {
  const Grains& g = airspace_.state.grains;
  const std::uint32_t i = slice_.pairs.first[pair], j = slice_.pairs.second[pair];
  const FixedVector there =
      border_.owns(j) ? position(j, step) : border_.foreign_motion(j, step, units_.fallen).position;
  const FixedVector apart = wrapped_difference(there, position(i, step));
  const double reach = g.radius[i] + g.radius[j];
  if (!overlapping(apart, reach, units_)) {
    const int deflected = deflected_of_pair(slice_, airspace_.courses, pair);
    // So close together, a contact may begin in any of the next steps.
    if (deflected > 0 && overlapping(apart, reach + deflected * leeway_.tolerance, units_))
      look_again(pair, step, reach, deflected);
    else
      appointments_.reconsider_pair(pair);
    return;
  }
  begin_contact(slice_, slice_.pair_contacts, meeting_of_grains(g, i, j, pair));
  take_up(slice_.pair_contacts, slice_.pair_contacts.size() - 1, step);
}

/// Has a pair looked at in every step: one that is closer than its deflected grains may be off
/// their courses. `reach` (m) is the sum of the radii.
void FlightRegion::look_again(std::uint32_t pair, std::int64_t step, double reach, int deflected) {
  const std::uint32_t i = slice_.pairs.first[pair], j = slice_.pairs.second[pair];
  if (!border_.owns(j)) {
    appointments_.make_for_next_step(pair, step, deflected);
    return;
  }
  constexpr double far_per_tolerance = 3.0;  // more than 1, so that pairs do not come and go
  const double far = reach + far_per_tolerance * deflected * leeway_.tolerance;
  const bool first_deflected = airspace_.courses.deflected(i);
  appointments_.watch(pair, first_deflected ? i : j, first_deflected ? j : i, reach, far, step);
}

/// Begins the contacts of a grain near a wall with wall grains. While it touches one it is looked
/// at in every step, as it may touch a second one.
void FlightRegion::look_at_near_wall(std::uint32_t near_wall, std::int64_t step) {
  const State& state = airspace_.state;
  const NearWall& near = slice_.near_walls[near_wall];
  const double reach = reach_at_wall(state, near);
  for_each_free_wall_grain(state, near, position(near.slot, step), units_, 0.0,
                           [&](std::int64_t k, const FixedVector& from_grain) {
                             if (!overlapping(from_grain, reach, units_)) return;
                             begin_contact(slice_, slice_.wall_contacts,
                                           meeting_at_wall(slice_, state, near_wall, k));
                             take_up(slice_.wall_contacts, slice_.wall_contacts.size() - 1, step);
                           });
  appointments_.reconsider_near_wall(near_wall);
}

/// Computes the kicks of this step by the contacts of the slice, removes those that have ended, and
/// notes their grains in let_go_.
void FlightRegion::step_contacts(std::int64_t step) {
  for (const DeflectedGrains::Place guest : guests_)
    deflected_.put(guest, border_.foreign_motion(deflected_.slot(guest), step, units_.fallen));
  const Bodies bodies = deflected_.bodies();
  slice_.pair_contacts.step(bodies, units_, airspace_.model);
  slice_.wall_contacts.step(bodies, units_, airspace_.model);
  deflected_.clear_kicks();

  LiveContacts& pairs = slice_.pair_contacts;
  complete_step(slice_, pairs, units_, [&](std::size_t i) {
    appointments_.end_contact(pairs.meeting(i).candidate);
    let_go(pairs.first(i));
    let_go(pairs.second(i));
  });
  LiveContacts& walls = slice_.wall_contacts;
  complete_step(slice_, walls, units_, [&](std::size_t i) { let_go(walls.first(i)); });
  count_work_of_walls(slice_, units_);
  for_each_kick(
      slice_, [&](std::int64_t place, const BodyKick& kick) { deflected_.add_kick(place, kick); });

  for (const DeflectedGrains::Place guest : guests_) {
    const Motion m = deflected_.motion(guest);
    border_.mine().deeds.push_back(
        {.slot = deflected_.slot(guest), .kick = {m.kick, m.spin_kick}, .contacts = 0});
  }
}

/// Takes up what contacts of other slices do to grains of this one.
void FlightRegion::suffer(std::int64_t step) {
  border_.mine().new_courses.clear();
  border_.for_each_before([&](const Announcement& other) {
    for (const Deed& deed : other.deeds) {
      if (!border_.owns(deed.slot)) continue;
      const DeflectedGrains::Place place = deflect(deed.slot, step);
      deflected_.add_kick(place, deed.kick);
      deflected_.contacts(place) += deed.contacts;
      if (deed.contacts < 0) let_go_.add(place);
    }
  });
}

/// Gives a new course to grains that would be beyond the tolerance in the next step.
void FlightRegion::correct_courses(std::int64_t step) {
  for (const DeflectedGrains::Place place : deflected_.off_course(leeway_.x, leeway_.y))
    if (!is_guest(place)) set_course(place, step);
}

void FlightRegion::announce(std::int64_t step) {
  Announcement& mine = border_.mine();
  tell_news(mine.trouble, slice_.failed());
  tell_news(mine.hold_until, skin_guard_.hold_until());
  tell_news(mine.fastest2, skin_guard_.fastest2());
  border_.announce_motion(deflected_, step);
}

/// Makes the grains of a new contact deflected ones or guests, and tells the contact their places.
void FlightRegion::take_up(LiveContacts& contacts, std::size_t contact, std::int64_t step) {
  const auto place_of = [&](std::int64_t body) {
    const auto slot = static_cast<std::uint32_t>(body);
    return border_.owns(slot) ? deflect(slot, step) : invite(slot);
  };
  const auto first = place_of(contacts.first(contact));
  const auto second = place_of(contacts.second(contact));
  contacts.move(contact, first, second);
  const Meeting& meeting = contacts.meeting(contact);
  if (!meeting.with_wall()) appointments_.begin_contact(meeting.candidate);
  change_contacts(first, 1);
  if (second != first) change_contacts(second, 1);  // at a wall they are equal
}

/// Returns the place of the own grain in `slot` among the deflected ones, which it joins if it
/// flies: then the appointments that relied on its keeping to the course are made anew.
DeflectedGrains::Place FlightRegion::deflect(std::uint32_t slot, std::int64_t step) {
  Courses& courses = airspace_.courses;
  if (!courses.deflected(slot)) {
    const DeflectedGrains::Place place = deflected_.take(slot, courses.motion(slot, step));
    courses.set_place(slot, static_cast<std::int32_t>(place));
    appointments_.reconsider_exact(slot);
  }
  return static_cast<DeflectedGrains::Place>(courses.place(slot));
}

/// Returns the place of the foreign grain in `slot`, which becomes a guest if it is none yet.
DeflectedGrains::Place FlightRegion::invite(std::uint32_t slot) {
  const auto there =
      std::find_if(guests_.begin(), guests_.end(),
                   [&](DeflectedGrains::Place guest) { return deflected_.slot(guest) == slot; });
  if (there != guests_.end()) return *there;
  guests_.push_back(deflected_.take(slot, {}));
  return guests_.back();
}

void FlightRegion::let_go(std::int64_t body) {
  const auto place = static_cast<DeflectedGrains::Place>(body);
  change_contacts(place, -1);
  let_go_.add(place);
}

void FlightRegion::change_contacts(DeflectedGrains::Place place, std::int32_t by) {
  deflected_.contacts(place) += by;
  if (is_guest(place))
    border_.mine().deeds.push_back({.slot = deflected_.slot(place), .kick = {}, .contacts = by});
}

void FlightRegion::release(DeflectedGrains::Place place) {
  if (is_guest(place))
    guests_.erase(std::find(guests_.begin(), guests_.end(), place));
  else
    airspace_.courses.set_place(deflected_.slot(place), Courses::flying);
  deflected_.release(place);
}

/// Gives an own grain a new course from its present position. With Kicks::to_come, its velocity is
/// the present one plus the last kick.
void FlightRegion::set_course(DeflectedGrains::Place place, std::int64_t step, Kicks kick) {
  const std::uint32_t slot = deflected_.slot(place);
  Motion course = deflected_.motion(place);
  if (kick == Kicks::to_come) course.take_up_kick();
  airspace_.courses.set(slot, course, step);
  deflected_.set_course(place);
  const std::int64_t hold_until = skin_guard_.note_course(slot, course, step);
  if (hold_until < needed_until_) border_.mine().strays.push_back({slot, hold_until});
  border_.announce_course(slot);
  appointments_.reconsider(slot);
}

}  // namespace riesel
