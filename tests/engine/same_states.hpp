// Whether two states are the same to the last bit.
#pragma once

#include "engine/observables.hpp"
#include "engine/state.hpp"
#include "tests/ordered_grains.hpp"

#include <algorithm>
#include <optional>
#include <tuple>
#include <vector>

namespace same_states {

using namespace riesel;

inline auto all_of(const Contact& c) {
  return std::tie(c.name, c.begin, c.end, c.entry_rate, c.entry_slip, c.overlap, c.max_overlap,
                  c.slip_path, c.elastic_energy, c.normal_loss, c.friction_loss, c.impulse_x,
                  c.impulse_y, c.impulse_y_times_time, c.friction_x, c.friction_y, c.spring,
                  c.torque, c.rolling_torque);
}

inline auto all_of(const ContactTally& t) {
  return std::tie(t.begun, t.ended, t.max_overlap, t.duration, t.slip_path, t.normal_loss,
                  t.friction_loss, t.energy_won, t.impulse_y, t.impulse_y_times_time, t.durations,
                  t.overlaps);
}

inline auto all_of(const BrakeTally& t) {
  return std::tie(t.contacts, t.cut_short, t.braking, t.braking_cut_short, t.friction_loss,
                  t.friction_loss_cut_short, t.entry_slip, t.duration, t.pulling);
}

inline auto all_of(const VisitTally& t) {
  return std::tie(t.of_contacts, t.contacts, t.dv_y, t.dv_x, t.entry_rate, t.entry_slip,
                  t.entry_rates, t.entry_slips);
}

inline auto all_of(const WallVisit& v) {
  return std::tie(v.wall, v.grain, v.span.begin, v.span.end, v.contacts, v.entry_rate, v.entry_slip,
                  v.impulse_x, v.impulse_y);
}

template <class Record>
bool same(const std::vector<Record>& a, const std::vector<Record>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Record& c, const Record& d) { return all_of(c) == all_of(d); });
}

inline bool same(const std::optional<Contact>& a, const std::optional<Contact>& b) {
  return a && b ? all_of(*a) == all_of(*b) : a.has_value() == b.has_value();
}

/// Every bit that a state holds, whether it is in the hash or not.
inline bool same(const State& a, const State& b) {
  const Grains g = ordered_by_id(a.grains), h = ordered_by_id(b.grains);
  return a.step == b.step && g.position == h.position && g.u == h.u && g.kick == h.kick
         && g.radius == h.radius && g.mass == h.mass && g.spin == h.spin
         && g.spin_kick == h.spin_kick && g.inertia == h.inertia && same(a.contacts, b.contacts)
         && same(a.open_visits, b.open_visits) && all_of(a.tally.grains) == all_of(b.tally.grains)
         && all_of(a.tally.walls) == all_of(b.tally.walls)
         && same(a.tally.grains.deepest, b.tally.grains.deepest)
         && same(a.tally.walls.deepest, b.tally.walls.deepest)
         && a.tally.impulses.y == b.tally.impulses.y
         && a.tally.impulses.work == b.tally.impulses.work
         && all_of(a.tally.brakes) == all_of(b.tally.brakes)
         && all_of(a.tally.visits) == all_of(b.tally.visits) && a.tally.ended_at_walls.empty()
         && b.tally.ended_at_walls.empty() && a.origin.energy == b.origin.energy
         && a.origin.momentum_y == b.origin.momentum_y && a.origin.moment_x == b.origin.moment_x
         && state_hash(a) == state_hash(b)
         && observe(a).energies.residual == observe(b).energies.residual;
}

}  // namespace same_states
