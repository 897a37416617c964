#include "engine/contact_loop.hpp"

#include <algorithm>

namespace riesel {

namespace {

void begin_pairs(Slice& slice, const Grains& g, const StepUnits& units) {
  const CandidatePairs& inner = slice.inner.pairs();
  for (const std::uint32_t near : slice.hits.items()) {
    const std::uint32_t i = inner.first[near], j = inner.second[near];
    if (!overlapping(wrapped_difference(g.position[j], g.position[i]), g.radius[i] + g.radius[j],
                     units))
      continue;
    const std::uint32_t p = slice.inner.candidate(near);
    begin_contact(slice, slice.pair_contacts, meeting_of_grains(g, i, j, p));
    slice.inner.leave_out(near);
  }
}

/// Begins the contacts of a grain with wall grains. Returns how far it may go (m) before it can
/// touch another wall grain.
double begin_at_wall(Slice& slice, const State& state, std::uint32_t place,
                     const StepUnits& units) {
  constexpr double room_of_reach = 0.1;  // more means rarer looks at more wall grains
  const NearWall& near = slice.near_walls[place];
  const double reach = reach_at_wall(state, near), farthest = (1.0 + room_of_reach) * reach;
  double closest2 = farthest * farthest;
  const auto look = [&](std::int64_t k, const FixedVector& from_grain) {
    if (overlapping(from_grain, reach, units))
      begin_contact(slice, slice.wall_contacts, meeting_at_wall(slice, state, place, k));
    else
      closest2 = std::min(closest2, squared_length(from_grain, units));
  };
  for_each_free_wall_grain(state, near, state.grains.position[near.slot], units, farthest - reach,
                           look);
  return (closest2 - reach * reach) / (farthest + reach);  // at most the distance less the reach
}

/// Begins the contacts with walls. Each grain is then left alone until it may touch a wall grain.
void begin_at_walls(Slice& slice, const State& state, const StepUnits& units) {
  constexpr double rounding = 1e-9;  // allowance for rounding errors, over the radius
  const WayPastWalls way = slice.way_past_walls;
  for (std::uint32_t place = 0; place < slice.near_walls.size(); ++place) {
    NearWall& near = slice.near_walls[place];
    if (near.is_clear(way)) continue;
    const WallLattice& wall = state.wall(near.wall);
    const double radius = state.grains.radius[near.slot];
    const double across =
        wall.distance_across(state.box.metres_x(state.grains.position[near.slot].x), radius)
        - rounding * radius;
    near.clear_until = {.across = way.across + across, .any = 0.0};
    if (across <= 0.0)
      near.clear_until.any =
          way.any + begin_at_wall(slice, state, place, units) - rounding * radius;
  }
}

/// Work of a wall along one axis, J per kg of the grain; the kicks and the displacement `u` of the
/// wall are in quanta.
double work_along(Fixed kick_of_grain, Fixed u, Fixed kick_of_wall, double to_velocity) {
  const double mean_velocity = (real(u) + 0.5 * real(kick_of_wall)) * to_velocity;
  return real(kick_of_grain) * to_velocity * mean_velocity;
}

}  // namespace

Meeting meeting_at_wall(const Slice& slice, const State& state, std::uint32_t near_wall,
                        std::int64_t k) {
  const NearWall& near = slice.near_walls[near_wall];
  return meeting_with_wall(state, near.slot, near.wall, k, near_wall);
}

void mark_in_contact(Slice& slice, const Meeting& meeting) {
  if (meeting.name.wall == no_wall)
    slice.pairs.begin_contact(meeting.candidate);
  else
    slice.near_walls[meeting.candidate].partners |= meeting.wall_bit;
}

void mark_apart(Slice& slice, const Meeting& meeting) {
  if (meeting.name.wall == no_wall)
    slice.pairs.end_contact(meeting.candidate);
  else
    slice.near_walls[meeting.candidate].end_contact(meeting.wall_bit);
}

void begin_contact(Slice& slice, LiveContacts& contacts, const Meeting& meeting) {
  if (slice.counts(meeting.name)) ++slice.tally.of(meeting.name).begun;
  mark_in_contact(slice, meeting);
  contacts.begin(meeting);
}

void resolve_contacts(Slice& slice, const State& state, const StepUnits& units,
                      const ContactModel& model) {
  begin_pairs(slice, state.grains, units);
  begin_at_walls(slice, state, units);
  for (LiveContacts* contacts : {&slice.pair_contacts, &slice.wall_contacts}) {
    contacts->step(bodies(state.grains), units, model);
    complete_step(slice, *contacts, units, [&](std::size_t i) {
      const Meeting& meeting = contacts->meeting(i);
      if (meeting.name.wall == no_wall) slice.inner.take_back(slice.pairs, meeting.candidate);
    });
  }
  count_work_of_walls(slice, units);
}

void count_work_of_walls(Slice& slice, const StepUnits& units) {
  if (!units.walls_move) return;
  const LiveContacts& contacts = slice.wall_contacts;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Meeting& m = contacts.meeting(i);
    if (!slice.counts(m.name)) continue;
    const BodyMotion& wall = units.walls[static_cast<std::size_t>(m.name.wall)];
    const BodyKick kick = contacts.kick_of_first(i);
    const double x = work_along(kick.by.x, wall.u.x, wall.kick.x, units.velocity_x);
    const double y = work_along(kick.by.y, wall.u.y, wall.kick.y, units.velocity_y);
    slice.tally.impulses.work.add(m.mass_first * (x + y));
  }
}

}  // namespace riesel
