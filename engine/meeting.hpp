// Two bodies that meet: which they are, and what does not change while they are in contact.
#pragma once

#include "engine/contact.hpp"
#include "engine/encounter.hpp"
#include "engine/state.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

namespace riesel {

struct Meeting {
  ContactName name;
  std::uint32_t candidate;     ///< index in Slice::pairs, or in Slice::near_walls
  std::int64_t first;          ///< place of the first body in Bodies, at the beginning
  std::int64_t second;         ///< of the second body; that of the first for a wall grain
  Fixed line, y;               ///< x and y of the wall grain before its wall moves; unused for free
                               ///< grains, y also for smooth walls
  double radius_first;         ///< m
  double radius_second;        ///< m
  double mass_first;           ///< kg
  double mass_second;          ///< kg; unused for a wall grain
  std::uint64_t wall_bit = 0;  ///< WallLattice::bit_of() the wall grain
  bool turned = false;         ///< the first body is not name.grain, but name.partner
  bool level = false;          ///< the second body always has the y of the first: a smooth wall

  bool with_wall() const { return name.wall != no_wall; }
  double reach() const { return radius_first + radius_second; }  ///< m
  double reduced_mass() const {                                  ///< kg
    return with_wall() ? mass_first : mass_first * mass_second / (mass_first + mass_second);
  }
  BodyPair bodies() const {
    return {.radius_first = radius_first,
            .radius_second = radius_second,
            .per_mass_first = 1.0 / mass_first,
            .per_mass_second = with_wall() ? 0.0 : 1.0 / mass_second};
  }
  ReducedPair reduced() const {
    const BodyPair pair = bodies();
    return {.reach = reach(),
            .mass = reduced_mass(),
            .per_mass = pair.per_mass_first + pair.per_mass_second};
  }
};

/// The meeting of two free grains, in slots i and j.
inline Meeting meeting_of_grains(const Grains& g, std::uint32_t i, std::uint32_t j,
                                 std::uint32_t candidate) {
  const bool turned = g.id[j] < g.id[i];
  return {.name = {no_wall, turned ? g.id[j] : g.id[i], turned ? g.id[i] : g.id[j]},
          .candidate = candidate,
          .first = i,
          .second = j,
          .line = 0,
          .y = 0,
          .radius_first = g.radius[i],
          .radius_second = g.radius[j],
          .mass_first = g.mass[i],
          .mass_second = g.mass[j],
          .turned = turned};
}

/// The meeting of the free grain in `slot` with grain `k` of a wall.
inline Meeting meeting_with_wall(const State& state, std::uint32_t slot, std::int32_t wall,
                                 std::int64_t k, std::uint32_t candidate) {
  const WallLattice& lattice = state.wall(wall);
  const Grains& g = state.grains;
  return {.name = {wall, g.id[slot], static_cast<std::int32_t>(k)},
          .candidate = candidate,
          .first = slot,
          .second = slot,
          .line = state.box.fixed_x(lattice.line),
          .y = lattice.smooth() ? 0 : lattice.place(k),
          .radius_first = g.radius[slot],
          .radius_second = lattice.radius,
          .mass_first = g.mass[slot],
          .mass_second = 0.0,
          .wall_bit = lattice.bit_of(k),
          .level = lattice.smooth()};
}

/// The slots of the free grains of a contact; at a wall `partner` is `grain`.
struct ContactSlots {
  std::uint32_t grain, partner;
};

/// `slots` as slots_by_id() returns it.
inline ContactSlots contact_slots(const ContactName& name, std::span<const std::size_t> slots) {
  const auto slot = [&](std::int32_t id) {
    return static_cast<std::uint32_t>(slots[static_cast<std::size_t>(id)]);
  };
  return {slot(name.grain), slot(name.wall == no_wall ? name.partner : name.grain)};
}

/// The meeting of a contact, without a candidate. name.grain is the first body.
inline Meeting meeting_of(const ContactName& name, const State& state, ContactSlots slots) {
  constexpr std::uint32_t none = 0;  // nobody looks for it
  return name.wall == no_wall
             ? meeting_of_grains(state.grains, slots.grain, slots.partner, none)
             : meeting_with_wall(state, slots.grain, name.wall, name.partner, none);
}

/// Position and motion of the wall grain in the step of `units`; `first` is the place of the first
/// body in `b`.
inline BodyMotion wall_point(const Meeting& m, const Bodies& b, std::int64_t first,
                             const StepUnits& units) {
  BodyMotion point = units.walls[static_cast<std::size_t>(m.name.wall)];
  point.position = wrapped_sum(FixedVector{m.line, m.y}, point.position);
  if (m.level) point.position.y = b.position[first].y;
  return point;
}

/// The encounter of the two bodies, seen from the first; `b` must have them at m.first and
/// m.second.
inline Encounter encounter(const Meeting& m, const Bodies& b, const StepUnits& units) {
  const BodyMotion motion =
      m.with_wall() ? relative_motion(b, m.first, wall_point(m, b, m.first, units), units)
                    : relative_motion(b, m.first, m.second);
  return encounter(motion, m.reduced(), units);
}

/// Likewise their turning, if they rotate.
inline Turning turning(const Meeting& m, const Bodies& b, double rolling_friction,
                       const StepUnits& units) {
  const Spin second = m.with_wall() ? Spin{} : spin_of(b, m.second, units);
  return turning(m.bodies(), spin_of(b, m.first, units), second, b.inertia, rolling_friction);
}

}  // namespace riesel
