#include "engine/flights.hpp"

#include "engine/contact_loop.hpp"
#include "engine/encounter.hpp"
#include "engine/kicks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace riesel {

namespace {

constexpr std::int32_t flying = -1;
/// Values of due_ that are no step.
constexpr std::int64_t never = -1, in_touch = -2;

/// How far a grain in contact may leave its course, as a part of the mean diameter: more means
/// fewer new courses, but more neighbours to look at in every step.
constexpr double tolerance_per_diameter = 0.004;

constexpr double forever = std::numeric_limits<double>::infinity();

/// Bounds are rounded to the safe side by this factor, which is far above the error of the
/// arithmetic.
constexpr double generous = 1.0 + 1e-9;

/// The candidates in contact, in order: a wall contact counts once for all wall grains that the
/// grain touches.
void list_touching(const Slice& slice, std::vector<std::uint32_t>& list) {
  const auto n_pairs = static_cast<std::uint32_t>(slice.pairs.size());
  list.clear();
  for (const auto& entry : slice.pair_contacts.entries())
    list.push_back(static_cast<std::uint32_t>(entry.key));
  for (const auto& entry : slice.wall_contacts.entries()) {
    const std::uint32_t candidate = n_pairs + static_cast<std::uint32_t>(entry.key >> 32);
    if (list.empty() || list.back() != candidate) list.push_back(candidate);
  }
}

bool beyond(Fixed deviation, Fixed tolerance) {
  return deviation > tolerance || deviation < -tolerance;
}

}  // namespace

Flights::Flights(State& state, const ContactModel& model, Candidates& candidates)
    : state_(state),
      model_(model),
      candidates_(candidates),
      slice_(candidates.slices().front()),
      fall_(fall_per_step(state)),
      tolerance_(tolerance_per_diameter * mean_diameter(state.grains)),
      tolerance_x_(nearest_fixed(tolerance_ * std::sqrt(0.5) / state.box.quantum_x())),
      tolerance_y_(nearest_fixed(tolerance_ * std::sqrt(0.5) / state.box.quantum_y())) {
  begin(state.step, state.step + 1);
}

/// What a step is, in the order in which it happens.
void Flights::step(std::int64_t step) {
  state_.step = step;
  move_deflected(step);
  if (!candidates_.spend_step(slice_)) {
    land_all(step);
    if (candidates_.look_again(state_, slice_, step)) begin(step, step);
  }
  keep_appointments(step);
  resolve_contacts(slice_, state_, model_);
  receive_kicks(state_.grains, candidates_.slices(), slice_);
  candidates_.note_speeds(state_, slice_);
  note_contacts();
  correct_courses(step);
}

void Flights::land_all(std::int64_t step) {
  CoarsePositions& coarse = candidates_.coarse();
  for (std::uint32_t i = 0; i < state_.grains.size(); ++i) {
    bring_to(i, step);
    coarse.x[i] = upper_half(state_.grains.x[i]);
    coarse.y[i] = upper_half(state_.grains.y[i]);
  }
}

/// Forgets all appointments and makes new ones, for candidates that have just been listed. All
/// grains are at `step`.
void Flights::begin(std::int64_t step, std::int64_t earliest) {
  const auto n_pairs = static_cast<std::uint32_t>(slice_.pairs.size());
  const auto candidates = n_pairs + static_cast<std::uint32_t>(slice_.near_walls.size());
  since_.assign(state_.grains.size(), step);
  deflected_at_.assign(state_.grains.size(), flying);
  deflected_.clear();
  calendar_.clear();
  due_.assign(candidates, never);
  link();

  for (const Kick& kick : slice_.received) deflect(kick.slot);
  list_touching(slice_, touching_);
  for (const std::uint32_t candidate : touching_) take_up(candidate);
  for (std::uint32_t candidate = 0; candidate < candidates; ++candidate)
    make_appointment(candidate, step, earliest);
}

/// Lists the candidates of each grain.
void Flights::link() {
  const auto n = static_cast<std::uint32_t>(due_.size());
  first_link_.assign(state_.grains.size() + 1, 0);
  for (std::uint32_t c = 0; c < n; ++c)
    for_each_grain_of(c, [&](std::uint32_t slot) { ++first_link_[slot + 1]; });
  for (std::size_t i = 1; i < first_link_.size(); ++i) first_link_[i] += first_link_[i - 1];

  links_.resize(first_link_.back());
  std::vector<std::uint32_t> next(first_link_.begin(), first_link_.end() - 1);
  for (std::uint32_t c = 0; c < n; ++c)
    for_each_grain_of(c, [&](std::uint32_t slot) { links_[next[slot]++] = c; });
}

void Flights::move_deflected(std::int64_t step) {
  Grains& g = state_.grains;
  const Fixed fallen = wrapped_product(fall_, step);
  for (Deflected& d : deflected_) {
    const std::uint32_t i = d.slot;
    g.ux[i] = wrapped_sum(g.ux[i], g.kick_x[i]);
    g.uy[i] = wrapped_sum(g.uy[i], g.kick_y[i]);
    g.x[i] = wrapped_sum(g.x[i], g.ux[i]);
    g.y[i] = wrapped_sum(g.y[i], wrapped_sum(g.uy[i], fallen));
    since_[i] = step;
    d.ux += g.kick_x[i];
    d.uy += g.kick_y[i];
    d.x += d.ux;
    d.y += d.uy;
  }
}

/// What is to be looked at in this step: the candidates in contact, and those that are due.
void Flights::keep_appointments(std::int64_t step) {
  looked_at_ = touching_;
  const std::size_t before = looked_at_.size();
  for (const std::uint32_t candidate : calendar_.due_in(step)) {
    if (due_[candidate] != step) continue;  // it has another appointment since
    due_[candidate] = never;                // once is enough, should it stand here twice
    for_each_grain_of(candidate, [&](std::uint32_t slot) { bring_to(slot, step); });
    looked_at_.push_back(candidate);
  }
  const auto new_ones = looked_at_.begin() + static_cast<std::ptrdiff_t>(before);
  std::sort(new_ones, looked_at_.end());
  std::inplace_merge(looked_at_.begin(), new_ones, looked_at_.end());

  const auto n_pairs = static_cast<std::uint32_t>(slice_.pairs.size());
  const auto first_wall = std::lower_bound(looked_at_.begin(), looked_at_.end(), n_pairs);
  slice_.hits.assign(looked_at_.begin(), first_wall);
  slice_.wall_hits.clear();
  std::transform(first_wall, looked_at_.end(), std::back_inserter(slice_.wall_hits),
                 [&](std::uint32_t candidate) { return candidate - n_pairs; });
}

/// Which contacts have begun, and which have ended?
void Flights::note_contacts() {
  list_touching(slice_, still_touching_);

  loose_.clear();
  std::set_difference(looked_at_.begin(), looked_at_.end(), still_touching_.begin(),
                      still_touching_.end(), std::back_inserter(loose_));
  for (const std::uint32_t candidate : loose_)
    if (due_[candidate] == in_touch) let_go(candidate);
  for (const std::uint32_t candidate : still_touching_)
    if (due_[candidate] != in_touch) take_up(candidate);
  touching_.swap(still_touching_);
}

/// Gives a course to grains that have begun a contact, ended their last one, or gone too far from
/// the old course.
void Flights::correct_courses(std::int64_t step) {
  changed_.clear();
  for (std::size_t k = 0; k < deflected_.size();) {
    Deflected& d = deflected_[k];
    const std::uint32_t slot = d.slot;
    if (d.contacts == 0) {
      changed_.push_back(slot);
      deflected_at_[slot] = flying;
      d = deflected_.back();
      deflected_.pop_back();
      if (k < deflected_.size()) deflected_at_[d.slot] = static_cast<std::int32_t>(k);
      continue;
    }
    if (d.fresh || strays(d)) {
      changed_.push_back(slot);
      d = on_new_course(slot, d.contacts);
    }
    ++k;
  }
  for (const std::uint32_t slot : changed_)
    for (std::uint32_t l = first_link_[slot]; l < first_link_[slot + 1]; ++l)
      make_appointment(links_[l], step, step + 1);
  for (const std::uint32_t candidate : loose_) make_appointment(candidate, step, step + 1);
}

/// Whether the grain will be too far from its course in the next step.
bool Flights::strays(const Deflected& d) const {
  const Grains& g = state_.grains;
  return beyond(d.x + d.ux + g.kick_x[d.slot], tolerance_x_)
         || beyond(d.y + d.uy + g.kick_y[d.slot], tolerance_y_);
}

/// With the candidates as they move now. Not before `earliest`.
void Flights::make_appointment(std::uint32_t candidate, std::int64_t now, std::int64_t earliest) {
  if (due_[candidate] == in_touch) return;
  const auto n_pairs = static_cast<std::uint32_t>(slice_.pairs.size());
  const double steps = candidate < n_pairs
                           ? free_steps_of_pair(candidate, now)
                           : free_steps_at_wall(slice_.near_walls[candidate - n_pairs], now);
  if (steps == forever) {
    due_[candidate] = never;
    return;
  }
  const auto wait =
      static_cast<std::int64_t>(std::min(steps, static_cast<double>(Calendar::horizon - 1)));
  const std::int64_t due = std::max(earliest, now + wait);
  if (due_[candidate] == due) return;
  due_[candidate] = due;
  calendar_.enter(candidate, due);
}

/// Steps that the two grains can do on their courses, and within their tolerances, before they can
/// touch.
double Flights::free_steps_of_pair(std::uint32_t pair, std::int64_t now) const {
  const std::uint32_t i = slice_.pairs.first[pair], j = slice_.pairs.second[pair];
  const Course a = course(i, now), b = course(j, now);
  const Box& box = state_.box;
  const double x = box.metres_x(wrapped_difference(b.x, a.x));
  const double y = box.metres_y(wrapped_difference(b.y, a.y));
  const double ux = box.metres_x(wrapped_difference(b.ux, a.ux));
  const double uy = box.metres_y(wrapped_difference(b.uy, a.uy));
  const double reach =
      (state_.grains.radius[i] + state_.grains.radius[j]) * generous + a.tolerance + b.tolerance;

  // The first s with |(x, y) + s (ux, uy)| = reach
  const double apart = x * x + y * y - reach * reach;
  if (apart <= 0.0) return 0.0;
  const double closing = -(x * ux + y * uy);
  if (closing <= 0.0) return forever;
  const double speed2 = ux * ux + uy * uy;
  const double root2 = closing * closing - speed2 * apart;
  if (root2 <= 0.0) return forever;
  return apart / (closing + std::sqrt(root2)) / generous;
}

/// The same for a grain and the wall grains in its way: it cannot touch one sooner than it could
/// cover the gap to the nearest, nor sooner than its straight way across the tube brings it into
/// the wall's reach.
double Flights::free_steps_at_wall(const NearWall& near, std::int64_t now) const {
  const WallLattice& wall = state_.walls[static_cast<std::size_t>(near.wall)];
  const Course c = course(near.slot, now);
  const Box& box = state_.box;
  const double reach = (state_.grains.radius[near.slot] + wall.radius) * generous + c.tolerance;
  const double ux = box.metres_x(c.ux);
  const double x = box.metres_x(c.x) - wall.line;

  const double beyond_reach = std::abs(x) - reach;
  if (beyond_reach > 0.0 && x * ux >= 0.0) return forever;
  const double across = beyond_reach > 0.0 ? beyond_reach / std::abs(ux) : 0.0;

  double nearest2 = forever;
  for_each_wall_grain_within(wall, box, c.y, 0.0, [&](std::int64_t, Fixed y) {
    const double dy = box.metres_y(wrapped_difference(y, c.y));
    nearest2 = std::min(nearest2, x * x + dy * dy);
  });
  const double gap = std::sqrt(nearest2) - reach;
  if (gap <= 0.0) return across / generous;
  const double fall = box.metres_y(fall_);
  const double uy = box.metres_y(wrapped_sum(c.uy, wrapped_product(fall_, now)));
  const double speed = std::hypot(ux, uy) + 0.5 * std::abs(fall);
  const double direct = 2.0 * gap / (speed + std::sqrt(speed * speed + 2.0 * std::abs(fall) * gap));
  return std::max(across, direct) / generous;
}

Flights::Course Flights::course(std::uint32_t slot, std::int64_t now) const {
  const Grains& g = state_.grains;
  if (deflected_at_[slot] != flying) {
    const Deflected& d = deflected_[static_cast<std::size_t>(deflected_at_[slot])];
    return {.x = wrapped_difference(g.x[slot], d.x),
            .y = wrapped_difference(g.y[slot], d.y),
            .ux = wrapped_difference(g.ux[slot], d.ux),
            .uy = wrapped_difference(g.uy[slot], d.uy),
            .tolerance = tolerance_};
  }
  return {.x = wrapped_sum(g.x[slot], flight_x(slot, now)),
          .y = wrapped_sum(g.y[slot], flight_y(slot, now)),
          .ux = g.ux[slot],
          .uy = g.uy[slot],
          .tolerance = 0.0};
}

/// Free flight to this step, exact.
void Flights::bring_to(std::uint32_t slot, std::int64_t step) {
  Grains& g = state_.grains;
  g.x[slot] = wrapped_sum(g.x[slot], flight_x(slot, step));
  g.y[slot] = wrapped_sum(g.y[slot], flight_y(slot, step));
  since_[slot] = step;
}

Fixed Flights::flight_x(std::uint32_t slot, std::int64_t step) const {
  return wrapped_product(step - since_[slot], state_.grains.ux[slot]);
}

Fixed Flights::flight_y(std::uint32_t slot, std::int64_t step) const {
  const std::int64_t steps = step - since_[slot];
  const std::int64_t sum_of_steps = steps * (since_[slot] + 1 + step) / 2;
  return wrapped_sum(wrapped_product(steps, state_.grains.uy[slot]),
                     wrapped_product(sum_of_steps, fall_));
}

/// From here, with the velocity of the next step, which includes the kick of this one.
Flights::Deflected Flights::on_new_course(std::uint32_t slot, std::int32_t contacts) const {
  return {.slot = slot,
          .contacts = contacts,
          .fresh = false,
          .x = 0,
          .y = 0,
          .ux = -state_.grains.kick_x[slot],
          .uy = -state_.grains.kick_y[slot]};
}

Flights::Deflected& Flights::deflect(std::uint32_t slot) {
  if (deflected_at_[slot] == flying) {
    deflected_at_[slot] = static_cast<std::int32_t>(deflected_.size());
    deflected_.push_back(on_new_course(slot, 0));
    deflected_.back().fresh = true;
  }
  return deflected_[static_cast<std::size_t>(deflected_at_[slot])];
}

/// A contact of this candidate lasts from now on.
void Flights::take_up(std::uint32_t candidate) {
  due_[candidate] = in_touch;
  for_each_grain_of(candidate, [&](std::uint32_t slot) { ++deflect(slot).contacts; });
}

/// It has ended.
void Flights::let_go(std::uint32_t candidate) {
  due_[candidate] = never;
  for_each_grain_of(candidate, [&](std::uint32_t slot) { --deflect(slot).contacts; });
}

template <class Visit>
void Flights::for_each_grain_of(std::uint32_t candidate, Visit visit) const {
  const auto n_pairs = static_cast<std::uint32_t>(slice_.pairs.size());
  if (candidate < n_pairs) {
    visit(slice_.pairs.first[candidate]);
    visit(slice_.pairs.second[candidate]);
  } else {
    visit(slice_.near_walls[candidate - n_pairs].slot);
  }
}

}  // namespace riesel
