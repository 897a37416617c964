#include "engine/flights.hpp"

#include "engine/contact_loop.hpp"
#include "engine/encounter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace riesel {

namespace {

constexpr std::int32_t flying = -1;
constexpr std::int32_t never = -1;

/// How far a grain in contact may leave its course, as a part of the mean diameter: more means
/// fewer new courses, but more neighbours to look at in every step.
constexpr double tolerance_per_diameter = 0.001;

/// Enough for vectors to be full, not so many that they leave the cache.
constexpr std::uint32_t appointments_at_a_time = 1024;

constexpr double forever = std::numeric_limits<double>::infinity();

}  // namespace

Flights::Flights(State& state, const ContactModel& model, Candidates& candidates)
    : state_(state),
      model_(model),
      candidates_(candidates),
      slice_(candidates.slices().front()),
      units_(state),
      tolerance_(tolerance_per_diameter * mean_diameter(state.grains)),
      tolerance_x_(nearest_fixed(tolerance_ * std::sqrt(0.5) / state.box.quantum_x())),
      tolerance_y_(nearest_fixed(tolerance_ * std::sqrt(0.5) / state.box.quantum_y())) {}

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
  make_appointments(step, step + 1);
  profile.done(Profile::Phase::appointments);
}

/// The courses of deflected grains are given up for their motion.
void Flights::land(std::int64_t step) {
  for (std::uint32_t slot = 0; slot < state_.grains.size(); ++slot)
    put_down(slot, motion(slot, step), step);
}

void Flights::take_off() {
  if (place_.empty()) {
    begin(state_.step, state_.step + 1);
    return;
  }
  for (DeflectedGrains::Place place = 0; place < deflected_.end(); ++place)
    if (deflected_.in_use(place)) set_course(place, state_.step);
  make_appointments(state_.step, state_.step + 1);
}

/// Makes the appointments of all candidates, which have just been listed. All grains are at `step`.
void Flights::begin(std::int64_t step, std::int64_t earliest) {
  const Grains& g = state_.grains;
  const auto candidates =
      static_cast<std::uint32_t>(slice_.pairs.size() + slice_.near_walls.size());
  deflected_.clear();
  place_.assign(g.size(), flying);
  stray_.assign(g.size(), 0.0);
  since_.assign(g.size(), step);
  sorted_at_ = step;
  hold_until_ = first_to_leave_skin();
  calendar_.clear();
  due_.assign(candidates, never);
  exact_.assign(candidates, 0);
  link();

  for (const Kick& kick : slice_.received) deflect(kick.slot, step);
  for (LiveContacts* contacts : {&slice_.pair_contacts, &slice_.wall_contacts})
    for (std::size_t i = 0; i < contacts->size(); ++i) take_up(*contacts, i, step);
  for (DeflectedGrains::Place place = 0; place < deflected_.end(); ++place) {
    set_course(place, step);
    if (deflected_.contacts(place) == 0) let_go_.push_back(place);
  }

  pairs_.clear();
  walls_.clear();
  for (std::uint32_t candidate = 0; candidate < candidates; ++candidate) {
    reconsider(candidate);
    if (candidate % appointments_at_a_time == 0) make_appointments(step, earliest);
  }
  make_appointments(step, earliest);
}

/// Finds the candidates of each grain. The pairs are ordered by their first grain: only where a
/// grain is the second, or near a wall, a list is needed.
void Flights::link() {
  const auto n_pairs = static_cast<std::uint32_t>(slice_.pairs.size());
  const auto n_walls = static_cast<std::uint32_t>(slice_.near_walls.size());
  const auto for_each_link = [&](auto visit) {
    for (std::uint32_t p = 0; p < n_pairs; ++p) visit(slice_.pairs.second[p], p);
    for (std::uint32_t w = 0; w < n_walls; ++w) visit(slice_.near_walls[w].slot, n_pairs + w);
  };
  first_pair_.assign(state_.grains.size() + 1, 0);
  first_link_.assign(state_.grains.size() + 1, 0);
  for (const std::uint32_t slot : slice_.pairs.first) ++first_pair_[slot + 1];
  for_each_link([&](std::uint32_t slot, std::uint32_t) { ++first_link_[slot + 1]; });
  for (std::size_t i = 1; i < first_link_.size(); ++i) {
    first_pair_[i] += first_pair_[i - 1];
    first_link_[i] += first_link_[i - 1];
  }
  links_.resize(first_link_.back());
  // Each link goes to the end of what is left of its grain's part.
  for_each_link([&](std::uint32_t slot, std::uint32_t candidate) {
    links_[--first_link_[slot + 1]] = candidate;
  });
  first_link_.erase(first_link_.begin());
  first_link_.push_back(static_cast<std::uint32_t>(links_.size()));
}

/// The candidates do not hold any more.
void Flights::renew(std::int64_t step) {
  slice_.profile.begin_build();
  land(step);
  candidates_.sort_anew(state_, slice_, step);
  begin(step, step);
  slice_.profile.done_build();
}

/// As leaves_skin(), for all grains when they have just been listed.
std::int64_t Flights::first_to_leave_skin() const {
  const Grains& g = state_.grains;
  double fastest2 = 0.0;
  for (std::size_t slot = 0; slot < g.size(); ++slot) {
    const double ux = state_.box.metres_x(g.ux[slot]);
    const double uy = state_.box.metres_y(wrapped_difference(g.uy[slot], candidates_.drift_y()));
    fastest2 = std::max(fastest2, ux * ux + uy * uy);
  }
  return sorted_at_ + Forecast::whole_steps(room_in_skin() / std::sqrt(fastest2)) - 1;
}

/// m; the positions of then are known but coarsely.
double Flights::room_in_skin() const {
  const double resolution = state_.box.metres_x(from_upper(1)) + state_.box.metres_y(from_upper(1));
  return (0.5 * candidates_.skin() - tolerance_ - resolution) / generous;
}

/// The step in which the grain, on its course and within the tolerance, may have gone farther than
/// the candidates allow: half the skin, relative to the common motion.
std::int64_t Flights::leaves_skin(std::uint32_t slot, std::int64_t now) const {
  const Grains& g = state_.grains;
  const Box& box = state_.box;
  const std::int64_t steps = now - sorted_at_;
  const Fixed common = wrapped_sum(wrapped_product(steps, candidates_.drift_y()),
                                   wrapped_product(sum_of_steps(sorted_at_, now), units_.fall));
  const CoarsePositions& then = candidates_.when_sorted();
  const double x = box.metres_x(wrapped_difference(course_x(slot, now), from_upper(then.x[slot])));
  const double y = box.metres_y(wrapped_difference(
      wrapped_difference(course_y(slot, now), from_upper(then.y[slot])), common));
  const double ux = box.metres_x(g.ux[slot]);
  const double uy = box.metres_y(wrapped_difference(g.uy[slot], candidates_.drift_y()));

  // The first s with |(x, y) + s (ux, uy)| = room
  const double room = room_in_skin();
  const double left = room * room - x * x - y * y;
  if (left <= 0.0) return now;
  const double speed2 = ux * ux + uy * uy;
  const double outward = x * ux + y * uy;
  const double steps_left = left / (outward + std::sqrt(outward * outward + speed2 * left));
  return now + Forecast::whole_steps(steps_left) - 1;
}

/// Looks at the candidates that are due: which contacts begin?
void Flights::keep_appointments(std::int64_t step) {
  const auto& today = calendar_.due_in(step);
  if (today.empty()) return;
  const auto n_pairs = static_cast<std::uint32_t>(slice_.pairs.size());
  for (const std::uint32_t candidate : today) {
    if (due_[candidate] != since_sorted(step)) continue;  // it has another appointment since
    due_[candidate] = never;
    if (candidate < n_pairs)
      look_at_pair(candidate);
    else
      look_at_wall(candidate - n_pairs);
  }
}

void Flights::look_at_pair(std::uint32_t pair) {
  const std::uint32_t i = slice_.pairs.first[pair], j = slice_.pairs.second[pair];
  const double reach = state_.grains.radius[i] + state_.grains.radius[j];
  if (!overlapping(wrapped_difference(x_now(j), x_now(i)), wrapped_difference(y_now(j), y_now(i)),
                   reach, units_)) {
    pairs_.push_back(pair);
    return;
  }
  begin_contact(slice_, slice_.pair_contacts, meeting_of_pair(slice_, state_.grains, pair));
  take_up(slice_.pair_contacts, slice_.pair_contacts.size() - 1, state_.step);
}

/// A grain that touches a wall is looked at in every step: it may touch a second wall grain.
void Flights::look_at_wall(std::uint32_t near_wall) {
  const NearWall& near = slice_.near_walls[near_wall];
  const Fixed x = x_now(near.slot), y = y_now(near.slot);
  for_each_touched_wall_grain(state_, near, x, y, units_, [&](std::int64_t k) {
    begin_contact(slice_, slice_.wall_contacts, meeting_at_wall(slice_, state_, near_wall, k));
    take_up(slice_.wall_contacts, slice_.wall_contacts.size() - 1, state_.step);
  });
  walls_.push_back(near_wall);
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
    place_[slot] = flying;
    stray_[slot] = 0.0;
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
  if (place_[slot] == flying) {
    place_[slot] = static_cast<std::int32_t>(deflected_.take(slot, motion(slot, step)));
    stray_[slot] = tolerance_;
    for_each_candidate_of(slot, [&](std::uint32_t candidate) {
      if (exact_[candidate] != 0) reconsider(candidate);
    });
  }
  return static_cast<DeflectedGrains::Place>(place_[slot]);
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
  put_down(slot,
           {.x = m.x,
            .y = m.y,
            .ux = wrapped_sum(m.ux, m.kick_x),
            .uy = wrapped_sum(m.uy, m.kick_y),
            .kick_x = 0,
            .kick_y = 0},
           step);
  deflected_.set_course(place);
  hold_until_ = std::min(hold_until_, leaves_skin(slot, step));
  for_each_candidate_of(slot, [&](std::uint32_t candidate) { reconsider(candidate); });
}

template <class Visit>
void Flights::for_each_candidate_of(std::uint32_t slot, Visit visit) const {
  for (std::uint32_t p = first_pair_[slot]; p < first_pair_[slot + 1]; ++p) visit(p);
  for (std::uint32_t l = first_link_[slot]; l < first_link_[slot + 1]; ++l) visit(links_[l]);
}

void Flights::reconsider(std::uint32_t candidate) {
  const auto n_pairs = static_cast<std::uint32_t>(slice_.pairs.size());
  if (candidate >= n_pairs)
    walls_.push_back(candidate - n_pairs);
  else
    pairs_.push_back(candidate);
}

/// For all that need one, with the grains as they move now. Not before `earliest`.
void Flights::make_appointments(std::int64_t now, std::int64_t earliest) {
  foresee(slice_.pairs, pairs_, courses(), state_.box, units_.fall, now, tolerance_, forecast_);
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    const std::uint32_t pair = pairs_[k];
    if (slice_.pairs.reach2[pair] < 0.0F) continue;  // in contact
    exact_[pair] = static_cast<std::uint8_t>(forecast_.exact[k]);
    enter(pair, forecast_.free_steps[k], now, earliest);
  }
  const auto n_pairs = static_cast<std::uint32_t>(slice_.pairs.size());
  for (const std::uint32_t near_wall : walls_) {
    exact_[n_pairs + near_wall] = 1;
    const double steps = free_steps_at_wall(slice_.near_walls[near_wall], now);
    enter(n_pairs + near_wall, Forecast::whole_steps(steps), now, earliest);
  }
  pairs_.clear();
  walls_.clear();
}

/// `free_steps` may be more than the calendar knows: then this is looked at once in between.
void Flights::enter(std::uint32_t candidate, std::int64_t free_steps, std::int64_t now,
                    std::int64_t earliest) {
  // Beyond this all is made anew; but the step that comes first is to be looked at in any case.
  if (now + free_steps > std::max(hold_until_, earliest)) {
    due_[candidate] = never;
    return;
  }
  const std::int64_t due = std::max(earliest, now + std::min(free_steps, Calendar::horizon - 1));
  if (due_[candidate] == since_sorted(due)) return;
  due_[candidate] = since_sorted(due);
  calendar_.enter(candidate, due);
}

/// Steps that a grain can do on its course, and within its tolerance, before it can touch a wall
/// grain: not fewer than it needs to cover the gap to the nearest, nor than its straight way across
/// the tube needs into the wall's reach.
double Flights::free_steps_at_wall(const NearWall& near, std::int64_t now) const {
  if (near.partners != 0) return 0.0;
  const WallLattice& wall = state_.walls[static_cast<std::size_t>(near.wall)];
  const Grains& g = state_.grains;
  const Box& box = state_.box;
  const double reach = (g.radius[near.slot] + wall.radius) * generous + stray_[near.slot];
  const double ux = box.metres_x(g.ux[near.slot]);
  const double x = box.metres_x(course_x(near.slot, now)) - wall.line;

  const double beyond_reach = std::abs(x) - reach;
  if (beyond_reach > 0.0 && x * ux >= 0.0) return forever;
  const double across = beyond_reach > 0.0 ? beyond_reach / std::abs(ux) : 0.0;

  const Fixed y = course_y(near.slot, now);
  double nearest2 = forever;
  for_each_wall_grain_within(wall, box, y, 0.0, [&](std::int64_t, Fixed there) {
    const double dy = box.metres_y(wrapped_difference(there, y));
    nearest2 = std::min(nearest2, x * x + dy * dy);
  });
  const double gap = std::sqrt(nearest2) - reach;
  if (gap <= 0.0) return across / generous;
  const double fall = box.metres_y(units_.fall);
  const double uy = box.metres_y(wrapped_sum(g.uy[near.slot], wrapped_product(units_.fall, now)));
  const double speed = std::hypot(ux, uy) + 0.5 * std::abs(fall);
  const double direct = 2.0 * gap / (speed + std::sqrt(speed * speed + 2.0 * std::abs(fall) * gap));
  return std::max(across, direct) / generous;
}

Courses Flights::courses() const {
  const Grains& g = state_.grains;
  return {.x = g.x.data(),
          .y = g.y.data(),
          .ux = g.ux.data(),
          .uy = g.uy.data(),
          .since = since_.data(),
          .radius = g.radius.data(),
          .stray = stray_.data()};
}

/// Free flight to this step, exact.
Fixed Flights::course_x(std::uint32_t slot, std::int64_t step) const {
  const Grains& g = state_.grains;
  return wrapped_sum(g.x[slot], wrapped_product(step - since_[slot], g.ux[slot]));
}

Fixed Flights::course_y(std::uint32_t slot, std::int64_t step) const {
  const Grains& g = state_.grains;
  const std::int64_t steps = step - since_[slot];
  return wrapped_sum(g.y[slot],
                     wrapped_sum(wrapped_product(steps, g.uy[slot]),
                                 wrapped_product(sum_of_steps(since_[slot], step), units_.fall)));
}

Fixed Flights::x_now(std::uint32_t slot) const {
  return place_[slot] == flying ? course_x(slot, state_.step) : deflected_.x(place_[slot]);
}

Fixed Flights::y_now(std::uint32_t slot) const {
  return place_[slot] == flying ? course_y(slot, state_.step) : deflected_.y(place_[slot]);
}

Motion Flights::motion(std::uint32_t slot, std::int64_t step) const {
  if (place_[slot] != flying)
    return deflected_.motion(static_cast<DeflectedGrains::Place>(place_[slot]));
  const Grains& g = state_.grains;
  return {.x = course_x(slot, step),
          .y = course_y(slot, step),
          .ux = g.ux[slot],
          .uy = g.uy[slot],
          .kick_x = g.kick_x[slot],
          .kick_y = g.kick_y[slot]};
}

void Flights::put_down(std::uint32_t slot, const Motion& m, std::int64_t step) {
  Grains& g = state_.grains;
  g.x[slot] = m.x;
  g.y[slot] = m.y;
  g.ux[slot] = m.ux;
  g.uy[slot] = m.uy;
  g.kick_x[slot] = m.kick_x;
  g.kick_y[slot] = m.kick_y;
  since_[slot] = step;
}

}  // namespace riesel
