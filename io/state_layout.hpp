// The names and units under which the parts of a State are stored in files: one list for both
// writers and readers, so that the two cannot drift apart.
//
// A member that is added to one of these structures must be added here. The compiler enforces it:
// the structured bindings and the sizes no longer match.
#pragma once

#include "engine/state.hpp"

#include <concepts>
#include <cstdint>
#include <type_traits>

namespace riesel::io {

/// Calls visit(name, unit, array, number) for each array of the grains (const or not), or part of
/// one: number(element) is the number that is stored. The spins come last; their arrays are empty
/// where the grains do not rotate.
template <class AnyGrains, class Visit>
void for_each_array(AnyGrains& grains, Visit visit) {
  auto& [position, u, kick, radius, mass, id, spin, spin_kick, inertia] = grains;
  const auto all = [](auto& element) -> auto& { return element; };
  const auto along_x = [](auto& element) -> auto& { return element.x; };
  const auto along_y = [](auto& element) -> auto& { return element.y; };
  visit("x", "quantum_x", position, along_x);
  visit("y", "quantum_y", position, along_y);
  visit("ux", "quantum_x / step", u, along_x);
  visit("uy", "quantum_y / step", u, along_y);
  visit("kick_x", "quantum_x / step^2", kick, along_x);
  visit("kick_y", "quantum_y / step^2", kick, along_y);
  visit("radius", "m", radius, all);
  visit("mass", "kg", mass, all);
  visit("id", "1", id, all);
  visit("spin", "2 pi / 2^64 / step", spin, all);
  visit("spin_kick", "2 pi / 2^64 / step^2", spin_kick, all);
}

/// Calls visit(name, unit, member) for each member of a contact's name; member(name) is the member.
template <std::same_as<ContactName> Record, class Visit>
void for_each_member(Visit visit) {
  static_assert(sizeof(ContactName) == 3 * sizeof(std::int32_t));
  visit(
      "wall", "1", [](auto& n) -> auto& { return n.wall; });
  visit(
      "grain", "1", [](auto& n) -> auto& { return n.grain; });
  visit(
      "partner", "1", [](auto& n) -> auto& { return n.partner; });
}

/// Calls visit(name, unit, member) for each member of a contact; member(contact) is the member.
template <std::same_as<Contact> Record, class Visit>
void for_each_member(Visit visit) {
  static_assert(sizeof(Contact) == 16 + 18 * sizeof(double));
  for_each_member<ContactName>([&](const char* name, const char* unit, auto member) {
    visit(
        name, unit, [member](auto& c) -> auto& { return member(c.name); });
  });
  visit(
      "begin", "s", [](auto& c) -> auto& { return c.begin; });
  visit(
      "end", "s", [](auto& c) -> auto& { return c.end; });
  visit(
      "entry_rate", "m/s", [](auto& c) -> auto& { return c.entry_rate; });
  visit(
      "entry_slip", "m/s", [](auto& c) -> auto& { return c.entry_slip; });
  visit(
      "overlap", "m", [](auto& c) -> auto& { return c.overlap; });
  visit(
      "max_overlap", "m", [](auto& c) -> auto& { return c.max_overlap; });
  visit(
      "slip_path", "m", [](auto& c) -> auto& { return c.slip_path; });
  visit(
      "elastic_energy", "J", [](auto& c) -> auto& { return c.elastic_energy; });
  visit(
      "normal_loss", "J", [](auto& c) -> auto& { return c.normal_loss; });
  visit(
      "friction_loss", "J", [](auto& c) -> auto& { return c.friction_loss; });
  visit(
      "impulse_x", "kg m/s", [](auto& c) -> auto& { return c.impulse_x; });
  visit(
      "impulse_y", "kg m/s", [](auto& c) -> auto& { return c.impulse_y; });
  visit(
      "impulse_y_times_time", "kg m", [](auto& c) -> auto& { return c.impulse_y_times_time; });
  visit(
      "friction_x", "N", [](auto& c) -> auto& { return c.friction_x; });
  visit(
      "friction_y", "N", [](auto& c) -> auto& { return c.friction_y; });
  visit(
      "spring", "m", [](auto& c) -> auto& { return c.spring; });
  visit(
      "torque", "N m", [](auto& c) -> auto& { return c.torque; });
  visit(
      "rolling_torque", "N m", [](auto& c) -> auto& { return c.rolling_torque; });
}

/// Calls visit(name, unit, member) for each member of an open visit; member(visit) is the member.
template <std::same_as<WallVisit> Record, class Visit>
void for_each_member(Visit visit) {
  static_assert(sizeof(WallVisit) == 8 + 5 * sizeof(double) + 2 * sizeof(ExactSum));
  visit(
      "wall", "1", [](auto& v) -> auto& { return v.wall; });
  visit(
      "grain", "1", [](auto& v) -> auto& { return v.grain; });
  visit(
      "begin", "s", [](auto& v) -> auto& { return v.span.begin; });
  visit(
      "end", "s", [](auto& v) -> auto& { return v.span.end; });
  visit(
      "contacts", "1", [](auto& v) -> auto& { return v.contacts; });
  visit(
      "entry_rate", "m/s", [](auto& v) -> auto& { return v.entry_rate; });
  visit(
      "entry_slip", "m/s", [](auto& v) -> auto& { return v.entry_slip; });
  visit(
      "impulse_x", "2^-90 kg m/s", [](auto& v) -> auto& { return v.impulse_x; });
  visit(
      "impulse_y", "2^-90 kg m/s", [](auto& v) -> auto& { return v.impulse_y; });
}

/// Calls visit(name, unit, member) for each member of a wall; member(wall) is the member.
template <std::same_as<WallLattice> Record, class Visit>
void for_each_member(Visit visit) {
  static_assert(sizeof(WallLattice) == 7 * sizeof(double) + 2 * sizeof(std::int64_t));
  visit(
      "line", "m", [](auto& wall) -> auto& { return wall.line; });
  visit(
      "radius", "m", [](auto& wall) -> auto& { return wall.radius; });
  visit(
      "count", "1", [](auto& wall) -> auto& { return wall.count; });
  visit(
      "velocity", "m/s", [](auto& wall) -> auto& { return wall.motion.velocity; });
  visit(
      "amplitude_x", "m", [](auto& wall) -> auto& { return wall.motion.amplitude_x; });
  visit(
      "amplitude_y", "m", [](auto& wall) -> auto& { return wall.motion.amplitude_y; });
  visit(
      "frequency", "1/s", [](auto& wall) -> auto& { return wall.motion.frequency; });
  visit(
      "phase", "rad", [](auto& wall) -> auto& { return wall.motion.phase; });
  visit(
      "start", "2^-64 of the period", [](auto& wall) -> auto& { return wall.motion.start; });
}

template <class Any, class T>
concept MaybeConst = std::same_as<std::remove_const_t<Any>, T>;

/// Calls visit(name, value) for each number, exact sum and array of counts of a tally (const or
/// not), in SI units. `deepest` is stored as contacts are.
template <MaybeConst<ContactTally> AnyTally, class Visit>
void for_each_value(AnyTally& tally, Visit visit) {
  auto& [begun, ended, max_overlap, duration, slip_path, normal_loss, friction_loss, energy_won,
         impulse_y, impulse_y_times_time, durations, overlaps, deepest] = tally;
  visit("begun", begun);
  visit("ended", ended);
  visit("max_overlap", max_overlap);
  visit("duration", duration);
  visit("slip_path", slip_path);
  visit("normal_loss", normal_loss);
  visit("friction_loss", friction_loss);
  visit("energy_won", energy_won);
  visit("impulse_y", impulse_y);
  visit("impulse_y_times_time", impulse_y_times_time);
  visit("durations", durations.counts());
  visit("overlaps", overlaps.counts());
}

template <MaybeConst<WallImpulses> AnyTally, class Visit>
void for_each_value(AnyTally& tally, Visit visit) {
  auto& [x, y, work] = tally;
  visit("left_x", x[0]);
  visit("right_x", x[1]);
  visit("left_y", y[0]);
  visit("right_y", y[1]);
  visit("work", work);
}

template <MaybeConst<BrakeTally> AnyTally, class Visit>
void for_each_value(AnyTally& tally, Visit visit) {
  auto& [contacts, cut_short, braking, braking_cut_short, friction_loss, friction_loss_cut_short,
         entry_slip, duration, pulling] = tally;
  visit("contacts", contacts);
  visit("cut_short", cut_short);
  visit("braking", braking);
  visit("braking_cut_short", braking_cut_short);
  visit("friction_loss", friction_loss);
  visit("friction_loss_cut_short", friction_loss_cut_short);
  visit("entry_slip", entry_slip);
  visit("duration", duration);
  visit("pulling", pulling);
}

template <MaybeConst<VisitTally> AnyTally, class Visit>
void for_each_value(AnyTally& tally, Visit visit) {
  auto& [of_contacts, contacts, dv_y, dv_x, entry_rate, entry_slip, entry_rates, entry_slips] =
      tally;
  visit("of_contacts", of_contacts);
  visit("contacts", contacts);
  visit("dv_y", dv_y);
  visit("dv_x", dv_x);
  visit("entry_rate", entry_rate);
  visit("entry_slip", entry_slip);
  visit("entry_rates", entry_rates.counts());
  visit("entry_slips", entry_slips.counts());
}

/// Calls visit(name, tally) for each kind of tally. `ended_at_walls` is empty between two advances.
template <MaybeConst<Tally> AnyTally, class Visit>
void for_each_kind(AnyTally& tally, Visit visit) {
  std::conditional_t<std::is_const_v<AnyTally>, const StepTally, StepTally>& of_steps = tally;
  auto& [grains, walls, impulses, ended_at_walls] = of_steps;
  static_assert(sizeof(Tally) == sizeof(StepTally) + sizeof(BrakeTally) + sizeof(VisitTally));
  visit("grains", grains);
  visit("walls", walls);
  visit("impulses", impulses);
  visit("brakes", tally.brakes);
  visit("visits", tally.visits);
}

/// Calls visit(name, value) for each scalar of a State (const or not), in SI units. The bindings
/// also name the members that are left to for_each_array() and the others, as they must name all.
template <class AnyState, class Visit>
void for_each_scalar(AnyState& state, Visit visit) {
  auto& [box, walls, gravity, time_step, step, grains, contacts, open_visits, tally, origin] =
      state;
  auto& [width, length] = box;
  auto& [energy, momentum_y, moment_x] = origin;
  visit("box_width", width);
  visit("box_length", length);
  visit("gravity_x", gravity.x);
  visit("gravity_y", gravity.y);
  visit("time_step", time_step);
  visit("step", step);
  visit("origin_energy", energy);
  visit("origin_momentum_y", momentum_y);
  visit("origin_moment_x", moment_x);
  visit("inertia", grains.inertia);
}

}  // namespace riesel::io
