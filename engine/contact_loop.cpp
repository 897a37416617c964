#include "engine/contact_loop.hpp"

#include "engine/encounter.hpp"

#include <algorithm>
#include <cmath>

namespace riesel {

namespace {

/// Collects the candidates that do overlap.
class Collector {
public:
  Collector(const Slice& slice, const State& state, const StepUnits& units, ContactBatch& batch)
      : slice_(slice), state_(state), grains_(state.grains), units_(units), batch_(batch) {}

  void pair(std::uint32_t p) {
    const std::uint32_t i = slice_.pairs.first[p], j = slice_.pairs.second[p];
    const Encounter e = encounter(grains_, i, j, units_);
    if (!overlapping(e)) return;
    const auto [a, b] = std::minmax(grains_.id[i], grains_.id[j]);
    batch_.add({.key = p, .name = {no_wall, a, b}, .first = i, .second = j}, e);
  }

  void wall(std::uint32_t place) {
    const NearWall& near = slice_.near_walls[place];
    const WallLattice& lattice = state_.walls[static_cast<std::size_t>(near.wall)];
    const Fixed line = state_.box.fixed_x(lattice.line);
    const double reach = grains_.radius[near.slot] + lattice.radius;
    for_each_wall_grain_within(
        lattice, state_.box, grains_.y[near.slot], reach, [&](std::int64_t k, Fixed y) {
          const Encounter e = encounter(grains_, near.slot, line, y, lattice.radius, units_);
          if (!overlapping(e)) return;
          const ContactName name{near.wall, grains_.id[near.slot], static_cast<std::int32_t>(k)};
          batch_.add({.key = wall_contact_key(place, name.partner),
                      .name = name,
                      .first = near.slot,
                      .second = no_slot},
                     e);
        });
  }

private:
  const Slice& slice_;
  const State& state_;
  const Grains& grains_;
  const StepUnits& units_;
  ContactBatch& batch_;
};

/// Carries the life of a contact on by one step.
void live(Contact& c, bool begins, const ContactBatch::Who& who, const Touch& t,
          const StepUnits& units) {
  if (begins) {
    c.name = who.name;
    c.begin = units.time - t.since;
    c.entry_rate = t.rate;
    c.entry_slip = t.slip;
  }
  c.end = units.time + t.until;
  c.overlap = t.overlap;
  c.max_overlap = std::max(c.max_overlap, t.overlap);
  c.slip_path += std::abs(t.slip) * units.dt;
  c.elastic_energy = t.elastic_energy;
  c.normal_loss += t.normal_power * units.dt;
  c.friction_loss += t.friction_power * units.dt;
  if (who.second == no_slot) {
    const double impulse = t.fy * units.dt;
    c.impulse_x += t.fx * units.dt;
    c.impulse_y += impulse;
    c.impulse_y_times_step += impulse * units.step;
  }
}

/// Kicks are integers: a force that is not a number, or beyond all bounds, must not become one.
bool usable(double kick) { return std::abs(kick) < 0x1p62; }

void kick(Slice& slice, const Grains& grains, std::uint32_t slot, double fx, double fy,
          const StepUnits& units, const ContactName& name) {
  const double per_mass = 1.0 / grains.mass[slot];
  const double x = fx * per_mass * units.kick_per_acceleration().x();
  const double y = fy * per_mass * units.kick_per_acceleration().y();
  if (usable(x) && usable(y))
    slice.kicks.push_back({slot, nearest_fixed(x), nearest_fixed(y)});
  else
    slice.trouble = name;
}

/// Kicks and lives of the contacts in the batch, which are ordered by key.
void settle(Slice& slice, const Grains& grains, ContactBook& book, const StepUnits& units) {
  const ContactBatch& batch = slice.batch;
  book.begin_step();
  for (std::size_t i = 0; i < batch.size(); ++i) {
    const ContactBatch::Who& who = batch.who(i);
    const Touch t = batch.touch(i);
    const auto [contact, begins] = book.meet(who.key, slice.tally);
    if (begins) ++slice.tally.of(who.name).begun;
    live(contact, begins, who, t, units);
    kick(slice, grains, who.first, t.fx, t.fy, units, who.name);
    if (who.second != no_slot) kick(slice, grains, who.second, -t.fx, -t.fy, units, who.name);
  }
  book.end_step(slice.tally);
}

}  // namespace

void resolve_contacts(Slice& slice, const State& state, const ContactModel& model) {
  const StepUnits units(state);
  Collector collector(slice, state, units, slice.batch);
  slice.kicks.clear();

  slice.batch.clear();
  for (const std::uint32_t p : slice.hits) collector.pair(p);
  slice.batch.touch_all(model, units.dt);
  settle(slice, state.grains, slice.pair_contacts, units);

  slice.batch.clear();
  for (const std::uint32_t place : slice.wall_hits) collector.wall(place);
  slice.batch.touch_all(model, units.dt);
  settle(slice, state.grains, slice.wall_contacts, units);
}

}  // namespace riesel
