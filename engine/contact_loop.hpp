// From candidates that may touch to the kicks of contacts: beginning, lasting, end.
#pragma once

#include "engine/contact_law.hpp"
#include "engine/meeting.hpp"
#include "engine/slice.hpp"
#include "engine/state.hpp"
#include "engine/wall_lattice.hpp"

#include <cstdint>

namespace riesel {

/// A grain near a wall in contact with grain `k` of it.
Meeting meeting_at_wall(const Slice& slice, const State& state, std::uint32_t near_wall,
                        std::int64_t k);

/// The contact lasts: nobody needs to look for it.
void note_lasting(Slice& slice, const Meeting& meeting);
/// It has ended.
void note_over(Slice& slice, const Meeting& meeting);

/// Begins in the step that is being done.
void begin_contact(Slice& slice, LiveContacts& contacts, const Meeting& meeting);

/// m, between the centres of a grain and a wall grain that touch.
inline double reach_at_wall(const State& state, const NearWall& near) {
  return state.grains.radius[near.slot] + state.wall(near.wall).radius;
}

/// Calls visit(k, from_grain) for the wall grains that `near`, which is at `place`, has within
/// `room` (m), and a few more, but for those that it is in contact with; `from_grain` leads to
/// them.
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

/// Completes the step of `contacts` that is that of `units`: tells trouble, counts those that have
/// ended and removes them; calls ended(i) before contact i goes.
template <class Ended>
void complete_step(Slice& slice, LiveContacts& contacts, const StepUnits& units, Ended ended) {
  if (const auto& contact = contacts.trouble())
    slice.trouble =
        first_of(slice.trouble, Trouble{static_cast<std::int64_t>(units.step), *contact});
  for (const std::size_t i : contacts.ended()) {
    const Meeting& meeting = contacts.meeting(i);
    if (slice.counts(meeting.name)) slice.tally.end(contacts.contact(i), meeting.reach());
    note_over(slice, meeting);
    ended(i);
    contacts.remove(i);
  }
}

/// Counts the work that moving walls do in this step, on the mean velocities before and after its
/// kicks, as loss_by_friction() does.
void count_work_of_walls(Slice& slice, const StepUnits& units);

/// Calls kick(place, body_kick) for what the last step of the contacts of `slice` gives to their
/// bodies; the place is that in the Bodies of that step.
template <class GiveKick>
void for_each_kick(const Slice& slice, GiveKick kick) {
  slice.pair_contacts.for_each_kick(kick);
  slice.wall_contacts.for_each_kick(kick);
}

/// One step of the contacts of `slice`: those that last, and those that begin among its hits and
/// its grains near walls. The grains that these concern are at the step of `units`; the kicks are
/// in the contacts then.
void resolve_contacts(Slice& slice, const State& state, const StepUnits& units,
                      const ContactModel& model);

}  // namespace riesel
