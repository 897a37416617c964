#include "engine/flights.hpp"

#include "engine/contact_loop.hpp"
#include "engine/encounter.hpp"

#include <algorithm>
#include <cmath>

namespace riesel {

namespace {

/// How far a grain in contact may leave its course, as a part of the mean diameter: more means
/// fewer new courses, but more neighbours to look at in every step.
constexpr double tolerance_per_diameter = 0.001;

}  // namespace

Flights::Flights(State& state, const ContactModel& model, Candidates& candidates)
    : state_(state),
      model_(model),
      candidates_(candidates),
      slice_(candidates.slices().front()),
      units_(state),
      tolerance_(tolerance_per_diameter * mean_diameter(state.grains)),
      tolerance_x_(nearest_fixed(tolerance_ * std::sqrt(0.5) / state.box.quantum_x())),
      tolerance_y_(nearest_fixed(tolerance_ * std::sqrt(0.5) / state.box.quantum_y())),
      courses_(state),
      skin_guard_(state, candidates, courses_, tolerance_),
      appointments_(state, slice_, courses_, tolerance_) {}

/// What a step is, in the order in which it happens.
void Flights::step(std::int64_t step) {
  Profile& profile = slice_.profile;
  profile.begin_step(step);
  state_.step = step;
  units_.move_to(step);
  deflected_.move(units_.fallen);
  profile.done(Profile::Phase::fly);
  if (step >= hold_until_) renew(step);
  keep_appointments(step);
  profile.done(Profile::Phase::search);
  step_contacts();
  profile.done(Profile::Phase::forces);
  correct_courses(step);
  appointments_.make(step, step + 1, hold_until_);
  profile.done(Profile::Phase::appointments);
}

/// The courses of deflected grains are given up for their motion.
void Flights::land(std::int64_t step) {
  for (std::uint32_t slot = 0; slot < state_.grains.size(); ++slot)
    courses_.set(slot, motion(slot, step), step);
}

void Flights::take_off() {
  if (!under_way_) {
    begin(state_.step, state_.step + 1);
    under_way_ = true;
    return;
  }
  for (DeflectedGrains::Place place = 0; place < deflected_.end(); ++place)
    if (deflected_.in_use(place)) set_course(place, state_.step);
  appointments_.make(state_.step, state_.step + 1, hold_until_);
}

/// Makes the appointments of all candidates, which have just been listed. All grains are at `step`.
void Flights::begin(std::int64_t step, std::int64_t earliest) {
  deflected_.clear();
  courses_.start_over(step);
  hold_until_ = skin_guard_.hold_until(SlotRange{slice_.begin, slice_.end});
  appointments_.start_over();

  for (const Kick& kick : slice_.received) deflect(kick.slot, step);
  for (LiveContacts* contacts : {&slice_.pair_contacts, &slice_.wall_contacts})
    for (std::size_t i = 0; i < contacts->size(); ++i) take_up(*contacts, i, step);
  for (DeflectedGrains::Place place = 0; place < deflected_.end(); ++place) {
    set_course(place, step);
    if (deflected_.contacts(place) == 0) let_go_.push_back(place);
  }

  appointments_.make_all(step, earliest, hold_until_);
}

/// The candidates do not hold any more.
void Flights::renew(std::int64_t step) {
  slice_.profile.begin_build();
  land(step);
  candidates_.sort_anew(state_, slice_, step);
  begin(step, step);
  slice_.profile.done_build();
}

/// Looks at the candidates that are due: which contacts begin?
void Flights::keep_appointments(std::int64_t step) {
  appointments_.keep(
      step, [&](std::uint32_t pair) { look_at_pair(pair, step); },
      [&](std::uint32_t near_wall) { look_at_near_wall(near_wall, step); });
}

void Flights::look_at_pair(std::uint32_t pair, std::int64_t step) {
  const std::uint32_t i = slice_.pairs.first[pair], j = slice_.pairs.second[pair];
  const double reach = state_.grains.radius[i] + state_.grains.radius[j];
  if (!overlapping(wrapped_difference(x(j, step), x(i, step)),
                   wrapped_difference(y(j, step), y(i, step)), reach, units_)) {
    appointments_.reconsider_pair(pair);
    return;
  }
  begin_contact(slice_, slice_.pair_contacts, meeting_of_pair(slice_, state_.grains, pair));
  take_up(slice_.pair_contacts, slice_.pair_contacts.size() - 1, step);
}

/// A grain that touches a wall is looked at in every step: it may touch a second wall grain.
void Flights::look_at_near_wall(std::uint32_t near_wall, std::int64_t step) {
  const NearWall& near = slice_.near_walls[near_wall];
  for_each_touched_wall_grain(
      state_, near, x(near.slot, step), y(near.slot, step), units_, [&](std::int64_t k) {
        begin_contact(slice_, slice_.wall_contacts, meeting_at_wall(slice_, state_, near_wall, k));
        take_up(slice_.wall_contacts, slice_.wall_contacts.size() - 1, step);
      });
  appointments_.reconsider_near_wall(near_wall);
}

/// Kicks of this step; contacts that have ended let their grains go.
void Flights::step_contacts() {
  const Bodies bodies = deflected_.bodies();
  slice_.pair_contacts.step(bodies, units_, model_);
  slice_.wall_contacts.step(bodies, units_, model_);
  deflected_.clear_kicks();

  LiveContacts& pairs = slice_.pair_contacts;
  complete_step(slice_, pairs, [&](std::size_t i) {
    let_go(pairs.first(i));
    let_go(pairs.second(i));
  });
  LiveContacts& walls = slice_.wall_contacts;
  complete_step(slice_, walls, [&](std::size_t i) { let_go(walls.first(i)); });
  for_each_kick(slice_,
                [&](std::int64_t place, Fixed x, Fixed y) { deflected_.add_kick(place, x, y); });
}

/// Gives a new course to grains that have ended a contact or go too far from the old course.
void Flights::correct_courses(std::int64_t step) {
  for (const DeflectedGrains::Place place : let_go_) {
    if (!deflected_.in_use(place)) continue;
    set_course(place, step);
    if (deflected_.contacts(place) > 0) continue;
    const std::uint32_t slot = deflected_.slot(place);
    courses_.set_place(slot, Courses::flying);
    deflected_.release(place);
  }
  let_go_.clear();
  for (const DeflectedGrains::Place place : deflected_.straying(tolerance_x_, tolerance_y_))
    set_course(place, step);
}

/// The grains of a contact are stepped from now on.
void Flights::take_up(LiveContacts& contacts, std::size_t contact, std::int64_t step) {
  const auto place_of = [&](std::int64_t slot) {
    return deflect(static_cast<std::uint32_t>(slot), step);
  };
  const auto first = place_of(contacts.first(contact));
  const auto second = place_of(contacts.second(contact));
  contacts.move(contact, first, second);
  ++deflected_.contacts(first);
  if (second != first) ++deflected_.contacts(second);  // it is no wall grain
}

/// The appointments that counted on its keeping to the course are made anew.
DeflectedGrains::Place Flights::deflect(std::uint32_t slot, std::int64_t step) {
  if (courses_.place(slot) == Courses::flying) {
    const DeflectedGrains::Place place = deflected_.take(slot, courses_.motion(slot, step));
    courses_.set_place(slot, static_cast<std::int32_t>(place));
    appointments_.reconsider_exact(slot);
  }
  return static_cast<DeflectedGrains::Place>(courses_.place(slot));
}

void Flights::let_go(std::int64_t place) {
  const auto grain = static_cast<DeflectedGrains::Place>(place);
  --deflected_.contacts(grain);
  let_go_.push_back(grain);
}

/// From here, with the velocity of the next step.
void Flights::set_course(DeflectedGrains::Place place, std::int64_t step) {
  const std::uint32_t slot = deflected_.slot(place);
  const Motion m = deflected_.motion(place);
  courses_.set(slot,
               {.x = m.x,
                .y = m.y,
                .ux = wrapped_sum(m.ux, m.kick_x),
                .uy = wrapped_sum(m.uy, m.kick_y),
                .kick_x = 0,
                .kick_y = 0},
               step);
  deflected_.set_course(place);
  hold_until_ = std::min(hold_until_, skin_guard_.hold_until(slot, step));
  appointments_.reconsider(slot);
}

Fixed Flights::x(std::uint32_t slot, std::int64_t step) const {
  const std::int32_t place = courses_.place(slot);
  return place == Courses::flying ? courses_.x(slot, step) : deflected_.x(place);
}

Fixed Flights::y(std::uint32_t slot, std::int64_t step) const {
  const std::int32_t place = courses_.place(slot);
  return place == Courses::flying ? courses_.y(slot, step) : deflected_.y(place);
}

Motion Flights::motion(std::uint32_t slot, std::int64_t step) const {
  const std::int32_t place = courses_.place(slot);
  return place == Courses::flying ? courses_.motion(slot, step)
                                  : deflected_.motion(static_cast<DeflectedGrains::Place>(place));
}

}  // namespace riesel
