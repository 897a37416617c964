// The contacts of a slice in one step, from candidates that may touch to kicks: which begin, which
// last and which have ended.
#pragma once

#include "engine/contact_law.hpp"
#include "engine/meeting.hpp"
#include "engine/slice.hpp"
#include "engine/state.hpp"
#include "engine/wall_lattice.hpp"

#include <cstdint>

namespace riesel {

/// The meeting of grain number `near_wall` in slice.near_walls with grain `k` of that wall.
Meeting meeting_at_wall(const Slice& slice, const State& state, std::uint32_t near_wall,
                        std::int64_t k);

/// Marks the candidate as in contact: searches leave it out from now on.
void mark_in_contact(Slice& slice, const Meeting& meeting);
/// Takes that mark away: the contact has ended.
void mark_apart(Slice& slice, const Meeting& meeting);

/// Adds, counts and marks a contact that begins in the present step.
void begin_contact(Slice& slice, LiveContacts& contacts, const Meeting& meeting);

/// m, between the centres of a grain and a wall grain that touch.
inline double reach_at_wall(const State& state, const NearWall& near) {
  return state.grains.radius[near.slot] + state.wall(near.wall).radius;
}

/// Calls visit(k, from_grain) for all wall grains that the grain of `near`, at position `place`,
/// would touch if it were `room` (m) larger, and perhaps for a few more, but not for those that it
/// is in contact with. `from_grain` (quanta) is the vector from the grain to wall grain k.
template <class Visit>
void for_each_free_wall_grain(const State& state, const NearWall& near, const FixedVector& place,
                              const StepUnits& units, double room, Visit visit) {
  const WallLattice& wall = state.wall(near.wall);
  const BodyMotion& moved = units.walls[static_cast<std::size_t>(near.wall)];
  const Fixed line = state.box.fixed_x(wall.line);
  const FixedVector back = wrapped_difference(place, moved.position);
  const double within = reach_at_wall(state, near) + room;
  for_each_wall_grain_within(wall, state.box, back.y, within, [&](std::int64_t k, Fixed there) {
    if ((near.partners & wall.bit_of(k)) == 0)
      visit(k, wrapped_difference(FixedVector{line, there}, back));
  });
}

/// Completes the step of `contacts`, which is that of `units`: reports trouble to the slice, counts
/// the contacts that have ended and removes them; calls ended(i) before contact i is removed.
template <class Ended>
void complete_step(Slice& slice, LiveContacts& contacts, const StepUnits& units, Ended ended) {
  if (const auto& contact = contacts.trouble())
    slice.trouble =
        first_of(slice.trouble, Trouble{static_cast<std::int64_t>(units.step), *contact});
  for (const std::size_t i : contacts.ended()) {
    const Meeting& meeting = contacts.meeting(i);
    if (slice.counts(meeting.name)) slice.tally.end(contacts.contact(i), meeting.reach());
    mark_apart(slice, meeting);
    ended(i);
    contacts.remove(i);
  }
}

/// Adds the work (J) that moving walls do in this step to the tally of the slice. It is that on the
/// mean of the velocities before and after the kicks, as in loss_by_friction().
void count_work_of_walls(Slice& slice, const StepUnits& units);

/// Calls kick(place, body_kick) for each kick by the last step of the contacts of `slice`; `place`
/// is the index of the body in the Bodies of that step.
template <class GiveKick>
void for_each_kick(const Slice& slice, GiveKick kick) {
  slice.pair_contacts.for_each_kick(kick);
  slice.wall_contacts.for_each_kick(kick);
}

/// Does one step of the contacts of `slice`: of those that last, and of those that begin among its
/// hits and its grains near walls. All grains concerned must be at the step of `units`. Afterwards
/// the kicks are in the contacts: see for_each_kick().
void resolve_contacts(Slice& slice, const State& state, const StepUnits& units,
                      const ContactModel& model);

}  // namespace riesel
