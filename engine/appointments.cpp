#include "engine/appointments.hpp"

#include "engine/parabola.hpp"
#include "engine/wall_lattice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace riesel {

namespace {

/// Candidates of a grain that are noted at a time: more than most grains have.
constexpr std::uint32_t candidates_at_a_time = 8;

/// Pairs that are sifted at a time: few enough to stay in the cache.
constexpr std::size_t pairs_at_a_time = 1024;

constexpr double forever = std::numeric_limits<double>::infinity();

/// The motion of a grain on its course from now on: s steps lead by u s + fall s^2 / 2.
struct Flight {
  FixedVector position;   // quanta
  double ux, uy;          // m per step
  double fall_x, fall_y;  // m per step^2
};

Flight flight_of(std::uint32_t slot, const State& state, const Courses& courses, std::int64_t now) {
  const Box& box = state.box;
  const FixedVector fall = courses.fall();
  const FixedVector u = wrapped_sum(state.grains.u[slot], wrapped_product(now, fall));
  const double fall_x = box.metres_x(fall.x), fall_y = box.metres_y(fall.y);
  // Whole steps lead by v s + fall s (s + 1) / 2.
  return {.position = courses.position(slot, now),
          .ux = box.metres_x(u.x) + 0.5 * fall_x,
          .uy = box.metres_y(u.y) + 0.5 * fall_y,
          .fall_x = fall_x,
          .fall_y = fall_y};
}

/// Steps that the grain can do before its distance across the tube from where the wall can ever be
/// is `reach` (m).
double steps_across(const Flight& f, const WallLattice& wall, const Box& box, double reach) {
  const double x = box.metres_x(f.position.x) - wall.line;
  const double gap = std::abs(x) - reach - std::abs(wall.motion.amplitude_x);
  const double to_wall = x > 0.0 ? -1.0 : 1.0;
  return gap > 0.0 ? steps_to_go(gap, to_wall * f.ux, to_wall * f.fall_x) : 0.0;
}

/// Steps that the grain can do before it can be within `reach` (m) of any wall grain: as if it, and
/// the wall, moved straight towards each other from their present distance.
double steps_to_nearest(const Flight& f, const WallLattice& wall, double reach, const State& state,
                        std::int64_t now) {
  const Box& box = state.box;
  const WallMotion& motion = wall.motion;
  const FixedVector shift =
      motion.is_ever_away() ? motion.shift(box, state.time_step, now) : FixedVector{0, 0};
  const double x = box.metres_x(f.position.x) - wall.line - box.metres_x(shift.x);
  const Fixed y = wrapped_difference(f.position.y, shift.y);
  double nearest2 = forever;
  for_each_wall_grain_within(wall, box, y, 0.0, [&](std::int64_t, Fixed there) {
    const double dy = box.metres_y(wrapped_difference(there, y));
    nearest2 = std::min(nearest2, x * x + dy * dy);
  });
  const double gap = std::sqrt(nearest2) - reach;
  if (gap <= 0.0) return 0.0;
  const double speed = std::hypot(f.ux, f.uy - motion.velocity * state.time_step)
                       + motion.fastest_oscillation() * state.time_step;
  return steps_to_go(gap, speed, std::hypot(f.fall_x, f.fall_y));
}

}  // namespace

void Appointments::fetch() const {
  riesel::fetch(std::span(due_));
  riesel::fetch(std::span(first_));
  riesel::fetch(std::span(links_));
}

void Appointments::start_over(double tolerance) {
  tolerance_ = tolerance;
  const std::size_t candidates = slice_.pairs.size() + slice_.near_walls.size();
  calendar_.clear();
  close_watch_.clear();
  due_.assign(candidates + candidates_at_a_time, {Appointment::never, false});
  reconsidered_.clear();
  link();
}

/// Lists the candidates of each grain. As the pairs are ordered by their first grain, only those of
/// which a grain is the second, and its walls, need a list.
void Appointments::link() {
  const std::uint32_t n_pairs = pair_count();
  const std::size_t begin = slice_.begin;
  const auto for_each_link = [&](auto visit) {
    for (std::uint32_t p = 0; p < n_pairs; ++p) visit(border_.number(slice_.pairs.second[p]), p);
    std::uint32_t candidate = n_pairs;
    for (const NearWall& near : slice_.near_walls) visit(near.slot - begin, candidate++);
  };
  first_.assign(border_.numbered() + 1, {});
  for (const std::uint32_t slot : slice_.pairs.first) ++first_[slot - begin + 1].pair;
  for_each_link([&](std::size_t grain, std::uint32_t) { ++first_[grain].link; });
  for (std::size_t i = 1; i < first_.size(); ++i) {
    first_[i].pair += first_[i - 1].pair;
    first_[i].link += first_[i - 1].link;
  }
  links_.clear();  // so that resize() need not copy, and takes no more memory than needed
  links_.resize(first_.back().link + candidates_at_a_time);
  // Now first_[i].link is one past the last link of grain i. Filling the lists from their ends
  // turns it into the index of the first.
  for_each_link([&](std::size_t grain, std::uint32_t candidate) {
    links_[--first_[grain].link] = candidate;
  });
}

/// Notes the candidates of a grain for which wanted(candidate) is true. Always writes several at a
/// time, also unwanted ones and ones beyond the last, to be overwritten: no branches.
template <class Wanted>
void Appointments::reconsider_if(std::uint32_t slot, Wanted wanted) {
  const std::size_t grain = border_.number(slot);
  const auto add = [&](std::uint32_t count, auto candidate) {
    for (std::uint32_t begin = 0; begin < count; begin += candidates_at_a_time) {
      std::uint32_t* const room = reconsidered_.room_for(candidates_at_a_time);
      std::size_t found = 0;
      for (std::uint32_t k = begin; k < begin + candidates_at_a_time; ++k) {
        room[found] = candidate(k);
        found +=
            static_cast<std::size_t>(wanted(room[found])) & static_cast<std::size_t>(k < count);
      }
      reconsidered_.take(found);
    }
  };
  const First first = first_[grain], end = first_[grain + 1];
  add(end.pair - first.pair, [&](std::uint32_t k) { return first.pair + k; });
  add(end.link - first.link, [&](std::uint32_t k) { return links_[first.link + k]; });
}

void Appointments::reconsider(std::uint32_t slot) {
  reconsider_if(slot, [](std::uint32_t) { return true; });
}

void Appointments::reconsider_exact(std::uint32_t slot) {
  reconsider_if(slot, [this](std::uint32_t candidate) { return due_[candidate].exact(); });
}

void Appointments::make_all(std::int64_t now, std::int64_t earliest, std::int64_t hold_until) {
  reconsidered_.clear();
  for (std::uint32_t near = 0; near < slice_.near_walls.size(); ++near) reconsider_near_wall(near);
  make(now, earliest, hold_until);
  const std::int64_t horizon = std::max(hold_until, earliest) - now;
  for (std::size_t begin = 0; begin < pair_count(); begin += pairs_at_a_time) {
    const std::size_t end = std::min<std::size_t>(begin + pairs_at_a_time, pair_count());
    sift(slice_, {begin, end}, state_, horizon, tolerance_, reconsidered_);
    make(now, earliest, hold_until);
  }
}

void Appointments::make_inside(std::int64_t now, std::int64_t earliest, std::int64_t hold_until) {
  put_off_.clear();
  reconsidered_.keep_if([&](std::uint32_t candidate) {
    if (candidate >= pair_count() || border_.owns(slice_.pairs.second[candidate])) return true;
    put_off_.add(candidate);
    return false;
  });
  make(now, earliest, hold_until);
  for (const std::uint32_t pair : put_off_.items()) reconsidered_.add(pair);
}

void Appointments::make(std::int64_t now, std::int64_t earliest, std::int64_t hold_until) {
  if (reconsidered_.empty()) return;
  // After hold_until all appointments are made anew; but `earliest` comes before that.
  const Period period{.now = now, .earliest = earliest, .latest = std::max(hold_until, earliest)};
  bool any_watched = false;
  reconsidered_.keep_if([&](std::uint32_t candidate) {
    if (candidate < pair_count()) {
      any_watched = any_watched | due_[candidate].is_watched();
      return !due_[candidate].is_in_contact();
    }
    const double steps =
        free_steps_at_wall(slice_.near_walls[candidate - pair_count()], period.now);
    enter(candidate, Forecast::whole_steps(steps), true, period);
    return false;
  });
  if (any_watched)
    reconsidered_.keep_if([this](std::uint32_t pair) { return !is_watched_on(pair); });
  const auto pairs = reconsidered_.items();
  Forecast forecast;
  for (std::size_t begin = 0; begin < pairs.size(); begin += Forecast::most_pairs) {
    const auto some = pairs.subspan(begin, std::min(Forecast::most_pairs, pairs.size() - begin));
    foresee(slice_, some, state_, courses_, now, tolerance_, forecast);
    enter_pairs(some, forecast, period);
  }
  reconsidered_.clear();
}

void Appointments::watch(std::uint32_t pair, std::uint32_t first, std::uint32_t second,
                         double reach, double far, std::int64_t step) {
  due_[pair] = Appointment::watched(close_watch_.size());
  close_watch_.add(pair, first, second, reach, far, step);
}

void Appointments::end_watch(std::uint32_t pair) {
  const std::size_t i = due_[pair].watched_as();
  due_[pair] = {Appointment::never, false};
  close_watch_.remove(i);
  if (i < close_watch_.size()) due_[close_watch_.pair(i)] = Appointment::watched(i);
}

/// Whether the pair is watched and stays so. If a grain of it has been deflected or let go since,
/// ends the watch.
bool Appointments::is_watched_on(std::uint32_t pair) {
  if (!due_[pair].is_watched()) return false;
  if (close_watch_.holds(due_[pair].watched_as())) return true;
  end_watch(pair);
  return false;
}

/// Enters what has just been foreseen. Most pairs do not touch before all appointments are made
/// anew; for these that is written without a branch.
void Appointments::enter_pairs(std::span<const std::uint32_t> pairs, const Forecast& forecast,
                               const Period& period) {
  std::array<std::uint32_t, Forecast::most_pairs> soon;
  std::size_t found = 0;
  for (std::uint32_t k = 0; k < pairs.size(); ++k) {
    const std::int64_t in_time = period.latest - period.now - forecast.free_steps[k];
    const auto late = static_cast<std::int32_t>(in_time >> 63);  // -1 if it is negative
    due_[pairs[k]].replace_by({Appointment::never, forecast.exact[k] != 0}, late);
    soon[found] = k;
    found += static_cast<std::size_t>(1 + late);
  }
  for (const std::uint32_t k : std::span(soon).first(found))
    enter(pairs[k], forecast.free_steps[k], forecast.exact[k] != 0, period);
}

void Appointments::make_for_next_step(std::uint32_t pair, std::int64_t now, int deflected) {
  enter(pair, 1, is_exact(deflected), {.now = now, .earliest = now + 1, .latest = now + 1});
}

/// Enters the appointment of one candidate. A step beyond the horizon of the calendar is replaced
/// by the last one within, when the candidate is looked at and gets another appointment.
void Appointments::enter(std::uint32_t candidate, std::int64_t free_steps, bool exact,
                         const Period& period) {
  const std::int64_t due = std::max(period.earliest, period.now + free_steps);
  if (due > period.latest) {
    due_[candidate] = {Appointment::never, exact};
    return;
  }
  const std::int64_t next = std::min(due, period.now + Calendar::horizon - 1);
  const bool entered = due_[candidate].is_for(since_sorted(next));
  due_[candidate] = {since_sorted(next), exact};
  if (!entered) calendar_.enter(candidate, next);
}

/// Steps that a grain can do on its course, or within the tolerance of it if it is deflected,
/// before it can touch a wall grain; 0 while it touches one.
double Appointments::free_steps_at_wall(const NearWall& near, std::int64_t now) const {
  if (near.partners != 0) return 0.0;
  const WallLattice& wall = state_.wall(near.wall);
  const double granted = courses_.deflected(near.slot) ? tolerance_ : 0.0;
  const double reach = (state_.grains.radius[near.slot] + wall.radius) * generous + granted;
  const Flight flight = flight_of(near.slot, state_, courses_, now);
  const double across = steps_across(flight, wall, state_.box, reach);
  if (across == forever) return forever;
  return std::max(across, steps_to_nearest(flight, wall, reach, state_, now)) / generous;
}

}  // namespace riesel
