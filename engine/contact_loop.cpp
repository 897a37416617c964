#include "engine/contact_loop.hpp"

#include "engine/contact_force.hpp"
#include "engine/encounter.hpp"

#include <algorithm>
#include <cmath>

namespace riesel {

namespace {

using Eigen::Vector2d;

/// A contact that is resolved: which kicks to give and what to remember it by.
struct Participants {
  ContactName name;
  std::uint32_t first;   // slot
  std::uint32_t second;  // slot, or `fixed`
};
constexpr std::uint32_t fixed = UINT32_MAX;  // the second body is a wall grain

/// Carries the life of a contact on by one step.
void live(Contact& c, bool begins, const ContactName& name, const Touch& t, double impulse_y,
          const StepUnits& units) {
  if (begins) {
    c.name = name;
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
  c.impulse_y += impulse_y;
  c.impulse_y_times_step += impulse_y * units.step;
}

/// Kicks are integers: a force that is not a number, or beyond all bounds, must not become one.
bool usable(const Vector2d& kick) { return kick.cwiseAbs().maxCoeff() < 0x1p62; }

template <class Normal, class Slip>
class Resolver {
 public:
  Resolver(Slice& slice, const State& state, const ContactModel& model, const Normal& normal,
           const Slip& slip)
      : slice_(slice), state_(state), grains_(state.grains), units_(state), normal_(normal),
        slip_(slip), mu_(model.friction), attraction_(model.attraction) {}

  void pairs() {
    slice_.pair_contacts.begin_step();
    for (const std::uint32_t p : slice_.hits) {
      const std::uint32_t i = slice_.pairs.first[p], j = slice_.pairs.second[p];
      const Encounter e = encounter(grains_, i, j, units_);
      if (!overlapping(e)) continue;
      const auto [a, b] = std::minmax(grains_.id[i], grains_.id[j]);
      resolve(e, {{no_wall, a, b}, i, j}, slice_.pair_contacts, p);
    }
    slice_.pair_contacts.end_step(slice_.tally);
  }

  void walls() {
    slice_.wall_contacts.begin_step();
    for (const std::uint32_t place : slice_.wall_hits) wall(slice_.near_walls[place], place);
    slice_.wall_contacts.end_step(slice_.tally);
  }

 private:
  void wall(const NearWall& near, std::size_t place) {
    const WallLattice& lattice = state_.walls[static_cast<std::size_t>(near.wall)];
    const Fixed line = state_.box.fixed_x(lattice.line);
    const double reach = grains_.radius[near.slot] + lattice.radius;
    for_each_wall_grain_within(
        lattice, state_.box, grains_.y[near.slot], reach, [&](std::int64_t k, Fixed y) {
          const Encounter e = encounter(grains_, near.slot, line, y, lattice.radius, units_);
          if (!overlapping(e)) return;
          const ContactName name{near.wall, grains_.id[near.slot], static_cast<std::int32_t>(k)};
          resolve(e, {name, near.slot, fixed}, slice_.wall_contacts,
                  wall_contact_key(place, name.partner));
        });
  }

  void resolve(const Encounter& e, const Participants& who, ContactBook& book, std::uint64_t key) {
    const Touch t = touch(e, normal_, slip_, mu_, attraction_, units_.dt);
    const auto [contact, begins] = book.meet(key, slice_.tally);
    if (begins) ++slice_.tally.of(who.name).begun;
    const double wall_impulse_y = who.second == fixed ? t.force.y() * units_.dt : 0.0;
    live(contact, begins, who.name, t, wall_impulse_y, units_);
    kick(who.first, t.force, who.name);
    if (who.second != fixed) kick(who.second, -t.force, who.name);
  }

  void kick(std::uint32_t slot, const Vector2d& force, const ContactName& name) {
    const Vector2d kick = units_.kick(force * (1.0 / grains_.mass[slot]));
    if (!usable(kick)) {
      slice_.trouble = name;
      return;
    }
    slice_.kicks.push_back({slot, nearest_fixed(kick.x()), nearest_fixed(kick.y())});
  }

  Slice& slice_;
  const State& state_;
  const Grains& grains_;
  const StepUnits units_;
  const Normal normal_;
  const Slip slip_;
  const double mu_;
  const Attraction attraction_;
};

}  // namespace

void resolve_contacts(Slice& slice, const State& state, const ContactModel& model) {
  slice.kicks.clear();
  std::visit(
      [&](const auto& normal, const auto& slip) {
        Resolver resolver(slice, state, model, normal, slip);
        resolver.pairs();
        resolver.walls();
      },
      model.normal, model.slip);
}

}  // namespace riesel
