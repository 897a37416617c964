#include "engine/state.hpp"

#include "engine/hash.hpp"
#include "engine/require.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

namespace riesel {

namespace {

void add(Hash& hash, const Grains& g, std::size_t slot) {
  for (const auto* vectors : {&g.position, &g.u, &g.kick}) {
    hash.add((*vectors)[slot].x);
    hash.add((*vectors)[slot].y);
  }
  hash.add(g.radius[slot]);
  hash.add(g.mass[slot]);
  if (!g.rotate()) return;
  hash.add(g.spin[slot]);
  hash.add(g.spin_kick[slot]);
}

/// Values that only some models have are hashed only where they are not 0, so that adding such a
/// model leaves the hashes of the others as they were.
void add_torques_and_spring(Hash& hash, const Contact& c) {
  if (c.spring != 0.0) hash.add(c.spring);
  if (c.torque == 0.0 && c.rolling_torque == 0.0) return;
  hash.add(c.torque);
  hash.add(c.rolling_torque);
}

// The bindings below name all members, so that none can be added without a look at its hash.

void add(Hash& hash, const WallMotion& motion) {
  const auto& [velocity, amplitude_x, amplitude_y, frequency, phase, start] = motion;
  for (const auto part : {velocity, amplitude_x, amplitude_y, frequency, phase}) hash.add(part);
  hash.add(start);
}

void add_tilt(Hash& hash, const State& state) {
  hash.add(state.gravity.x);
  hash.add(state.origin.moment_x);
}

void add(Hash& hash, const Contact& c) {
  for (const auto part : {c.name.wall, c.name.grain, c.name.partner}) hash.add(part);
  for (const auto part : {c.begin, c.end, c.entry_rate, c.entry_slip, c.max_overlap, c.slip_path,
                          c.normal_loss, c.friction_loss, c.impulse_x, c.impulse_y,
                          c.impulse_y_times_time, c.friction_x, c.friction_y})
    hash.add(part);
  add_torques_and_spring(hash, c);
}

void add(Hash& hash, const ExactSum& sum) {
  hash.add(sum.high());
  hash.add(sum.low());
}

/// Without the deepest contact, of which max_overlap tells.
void add(Hash& hash, const ContactTally& tally) {
  const auto& [begun, ended, max_overlap, duration, slip_path, normal_loss, friction_loss,
               energy_won, impulse_y, impulse_y_times_time, durations, overlaps, deepest] = tally;
  hash.add(begun);
  hash.add(ended);
  hash.add(max_overlap);
  for (const auto* sum :
       {&duration, &slip_path, &normal_loss, &friction_loss, &impulse_y, &impulse_y_times_time})
    add(hash, *sum);
  if (energy_won != ExactSum{}) add(hash, energy_won);
  for (const auto count : durations.counts()) hash.add(count);
  for (const auto count : overlaps.counts()) hash.add(count);
}

void add(Hash& hash, const WallVisit& visit) {
  const auto& [wall, grain, span, contacts, entry_rate, entry_slip, impulse_x, impulse_y] = visit;
  for (const auto part : {wall, grain}) hash.add(part);
  for (const auto part : {span.begin, span.end, entry_rate, entry_slip}) hash.add(part);
  hash.add(contacts);
  add(hash, impulse_x);
  add(hash, impulse_y);
}

void add(Hash& hash, const BrakeTally& tally) {
  const auto& [contacts, cut_short, braking, braking_cut_short, friction_loss,
               friction_loss_cut_short, entry_slip, duration, pulling] = tally;
  hash.add(contacts);
  hash.add(cut_short);
  for (const auto* sum : {&braking, &braking_cut_short, &friction_loss, &friction_loss_cut_short,
                          &entry_slip, &duration, &pulling})
    add(hash, *sum);
}

void add(Hash& hash, const VisitTally& tally) {
  const auto& [of_contacts, contacts, dv_y, dv_x, entry_rate, entry_slip, entry_rates,
               entry_slips] = tally;
  for (const auto count : of_contacts) hash.add(count);
  hash.add(contacts);
  for (const auto* sum : {&dv_y, &dv_x, &entry_rate, &entry_slip}) add(hash, *sum);
  for (const auto* histogram : {&entry_rates, &entry_slips})
    for (const auto count : histogram->counts()) hash.add(count);
}

}  // namespace

void Grains::resize(std::size_t n) {
  for_each_array_of(*this, [&](auto& array) { array.resize(n); });
}

FixedVector fall_per_step(const State& state) {
  const double dt = state.time_step;
  return {nearest_fixed(state.gravity.x * dt * dt / state.box.quantum_x()),
          nearest_fixed(state.gravity.y * dt * dt / state.box.quantum_y())};
}

void add_grain(State& state, const Grain& grain) {
  // Beyond this integers wrap, and a grain would be elsewhere, or fly another way.
  const double dt = state.time_step;
  require(std::abs(grain.x) < 4.0 * state.box.width
              && std::abs(grain.vx) * dt < 4.0 * state.box.width
              && std::abs(grain.vy) * dt < 0.5 * state.box.length && std::isfinite(grain.y),
          "a grain beyond the space of the box, or one that crosses half of it in a step");
  Grains& g = state.grains;
  require(!g.rotate() || std::abs(grain.spin) * dt < std::numbers::pi,
          "a grain that makes half a turn in a step");
  const std::size_t i = g.size();
  g.resize(i + 1);
  g.position[i].x = state.box.fixed_x(grain.x);
  g.position[i].y = state.box.fixed_y(grain.y);
  const FixedVector fall = fall_per_step(state);
  g.u[i].x = wrapped_difference(nearest_fixed(grain.vx * dt / state.box.quantum_x()), fall.x / 2);
  g.u[i].y = wrapped_difference(nearest_fixed(grain.vy * dt / state.box.quantum_y()), fall.y / 2);
  g.radius[i] = grain.radius;
  g.mass[i] = grain.mass;
  g.id[i] = static_cast<std::int32_t>(i);
  if (g.rotate()) g.spin[i] = nearest_fixed(grain.spin * state.time_step / quantum_of_angle);
}

GrainView::GrainView(const State& state)
    : grains_(&state.grains),
      box_(state.box),
      fall_(fall_per_step(state)),
      fallen_(wrapped_product(state.step, fall_)),
      to_vx_(state.box.quantum_x() / state.time_step),
      to_vy_(state.box.quantum_y() / state.time_step),
      to_spin_(quantum_of_angle / state.time_step) {}

std::vector<std::size_t> slots_by_id(const Grains& grains) {
  const auto last = std::max_element(grains.id.begin(), grains.id.end());
  std::vector<std::size_t> slots(last == grains.id.end() ? 0 : static_cast<std::size_t>(*last) + 1);
  for (std::size_t slot = 0; slot < grains.size(); ++slot)
    slots[static_cast<std::size_t>(grains.id[slot])] = slot;
  return slots;
}

Grain grain_at(const State& state, std::size_t slot) { return GrainView(state)[slot]; }

double mean_diameter(const Grains& grains) {
  ExactSum radii;
  for (const double radius : grains.radius) radii.add(radius);
  return 2.0 * radii.value() / static_cast<double>(grains.size());
}

double mean_mass(const Grains& grains) {
  return total_mass(grains) / static_cast<double>(grains.size());
}

double total_mass(const Grains& grains) {
  ExactSum sum;
  for (const double mass : grains.mass) sum.add(mass);
  return sum.value();
}

std::string when(std::int64_t step, double time_step) {
  std::ostringstream text;
  text << "at t = " << static_cast<double>(step) * time_step << " s (step " << step << ")";
  return text.str();
}

std::uint64_t state_hash(const State& state) {
  Hash hash;
  hash.add(state.box.width);
  hash.add(state.box.length);
  hash.add(state.gravity.y);
  if (state.gravity.x != 0.0) add_tilt(hash, state);
  hash.add(state.time_step);
  hash.add(state.step);
  hash.add(state.origin.energy);
  hash.add(state.origin.momentum_y);
  for (const WallLattice& wall : state.walls) {
    hash.add(wall.line);
    hash.add(wall.radius);
    hash.add(wall.count);
    if (wall.motion.is_ever_away()) add(hash, wall.motion);
  }
  if (state.grains.rotate()) hash.add(state.grains.inertia);
  for (const std::size_t slot : slots_by_id(state.grains)) add(hash, state.grains, slot);
  for (const Contact& contact : state.contacts) add(hash, contact);
  for (const WallVisit& visit : state.open_visits) add(hash, visit);
  add(hash, state.tally.grains);
  add(hash, state.tally.walls);
  if (state.tally.impulses.work != ExactSum{}) add(hash, state.tally.impulses.work);
  add(hash, state.tally.brakes);
  add(hash, state.tally.visits);
  return hash.value();
}

}  // namespace riesel
