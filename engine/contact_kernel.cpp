#include "engine/contact_kernel.hpp"

#include "engine/vector_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace riesel {

namespace {

/// Advances the motion of the second grain relative to the first by one step. Gravity is the same
/// for both, and integers give the same bits as a difference of the two grains would. The only new
/// input are the last kicks of the two grains, by all their contacts.
[[gnu::always_inline]] inline BodyMotion next_motion(ContactTile& c, std::size_t i) {
  const FixedVector kick = c.partner.kick.at(i);
  const FixedVector u = wrapped_sum(c.partner.u.at(i), kick);
  const FixedVector position = wrapped_sum(c.partner.position.at(i), u);
  c.partner.position.set(i, position);
  c.partner.u.set(i, u);
  return {.position = position, .u = u, .kick = kick};
}

[[gnu::always_inline]] inline BodyMotion
motion_of_wall(ContactTile& c, std::size_t i, const Bodies& bodies, const StepUnits& units) {
  return relative_motion(
      bodies, c.body[0][i],
      {.position = c.partner.position.at(i), .u = c.partner.u.at(i), .kick = c.partner.kick.at(i)},
      units);
}

[[gnu::always_inline]] inline ReducedPair reduced_pair(const ContactTile& c, std::size_t i) {
  return {.reach = c.reach[i],
          .mass = c.reduced_mass[i],
          .per_mass = c.per_mass[0][i] + c.per_mass[1][i]};
}

/// From the present motion of both bodies.
template <class Numbers, Partner partner>
[[gnu::always_inline]] inline Encounter encounter_of(ContactTile& c, std::size_t i,
                                                     const Bodies& bodies, const StepUnits& units) {
  if constexpr (partner == Partner::grain)
    return encounter<Numbers>(relative_motion(bodies, c.body[0][i], c.body[1][i]),
                              reduced_pair(c, i), units);
  else
    return encounter<Numbers>(motion_of_wall(c, i, bodies, units), reduced_pair(c, i), units);
}

/// The same for a contact whose relative motion is known at the step before.
template <class Numbers, Partner partner>
[[gnu::always_inline]] inline Encounter
next_encounter(ContactTile& c, std::size_t i, const Bodies& bodies, const StepUnits& units) {
  if constexpr (partner == Partner::grain)
    return encounter<Numbers>(next_motion(c, i), reduced_pair(c, i), units);
  else
    return encounter_of<Numbers, partner>(c, i, bodies, units);
}

template <class Numbers, Partner partner, class Turn>
[[gnu::always_inline]] inline Turn turning_of(ContactTile& c, std::size_t i, const Bodies& bodies,
                                              double rolling_friction, const StepUnits& units) {
  if constexpr (std::is_same_v<Turn, Turning>) {
    Spin second;
    if constexpr (partner == Partner::grain) second = spin_of<Numbers>(bodies, c.body[1][i], units);
    return turning({.radius_first = c.radius[0][i],
                    .radius_second = c.radius[1][i],
                    .per_mass_first = c.per_mass[0][i],
                    .per_mass_second = c.per_mass[1][i]},
                   spin_of<Numbers>(bodies, c.body[0][i], units), second, bodies.inertia,
                   rolling_friction);
  } else {
    return {};
  }
}

/// In its first step a contact stretches its spring from `begin` on, not for the whole step.
template <class Slip>
[[gnu::always_inline]] inline Stretch stretch_of(ContactTile& c, std::size_t i,
                                                 const StepUnits& u) {
  if constexpr (Slip::has_spring)
    return {.spring = c.life[RIESEL_LIFE(spring)][i],
            .time = std::min(u.dt, u.time - c.life[RIESEL_LIFE(begin)][i])};
  else
    return {.spring = 0.0, .time = 0.0};
}

/// J, what friction dissipated in the step before, as Contact::friction_loss counts it: without
/// what went into the spring. life(member) is as that step left it; `spring_energy` (J) is what is
/// in the spring now, 0 when the contact is over: what was left in it counts as dissipated.
template <class Life, class Turn, class Slip>
[[gnu::always_inline]] inline double loss_before(const Life& life, const Encounter& e,
                                                 const Turn& turn, const Slip& slip,
                                                 double spring_energy, double dt) {
  double loss =
      loss_by_friction(life(RIESEL_LIFE(friction_x)), life(RIESEL_LIFE(friction_y)), e, dt);
  if constexpr (std::is_same_v<Turn, Turning>)
    loss += loss_by_torques(life(RIESEL_LIFE(torque)), life(RIESEL_LIFE(rolling_torque)), turn, dt);
  if constexpr (Slip::has_spring)
    loss -= spring_energy - slip.stored_energy(life(RIESEL_LIFE(spring)));
  return loss;
}

/// Updates the life of contact i by one step if the bodies touch. The loss by friction in the step
/// before is added even if the contact is over.
template <Partner partner, class Turn, class Slip>
[[gnu::always_inline]] inline void carry_on(ContactTile& c, std::size_t i, bool touching,
                                            const Encounter& e, const Turn& turn, const Touch& t,
                                            const Slip& slip, const StepUnits& u) {
  const auto set = [&](std::size_t member, double value) {
    const double before = c.life[member][i];
    c.life[member][i] = touching ? value : before;
  };
  const auto add = [&](std::size_t member, double value) {
    c.life[member][i] += touching ? value : 0.0;
  };
  const auto life = [&](std::size_t member) { return c.life[member][i]; };
  c.life[RIESEL_LIFE(friction_loss)][i] +=
      loss_before(life, e, turn, slip, touching ? t.spring_energy : 0.0, u.dt);
  set(RIESEL_LIFE(friction_x), t.friction_x);
  set(RIESEL_LIFE(friction_y), t.friction_y);
  const double deepest = c.life[RIESEL_LIFE(max_overlap)][i];
  set(RIESEL_LIFE(end), u.time + t.until);
  set(RIESEL_LIFE(overlap), t.overlap);
  set(RIESEL_LIFE(max_overlap), std::max(deepest, t.overlap));
  set(RIESEL_LIFE(elastic_energy), t.elastic_energy);
  add(RIESEL_LIFE(slip_path), std::abs(t.slip) * u.dt);
  add(RIESEL_LIFE(normal_loss), t.normal_power * u.dt);
  if constexpr (partner == Partner::wall) {
    add(RIESEL_LIFE(impulse_x), t.fx * u.dt);
    add(RIESEL_LIFE(impulse_y), t.fy * u.dt);
    add(RIESEL_LIFE(impulse_y_times_time), t.fy * u.dt * u.time);
  }
  if constexpr (Slip::has_spring) set(RIESEL_LIFE(spring), t.spring);
  if constexpr (std::is_same_v<Turn, Turning>) {
    set(RIESEL_LIFE(torque), t.torque);
    set(RIESEL_LIFE(rolling_torque), t.rolling_torque);
  }
}

/// Writes the kicks of contact i; returns the sum of their sizes in quanta, which is NaN if one of
/// them is.
template <class Numbers, Partner partner>
[[gnu::always_inline]] inline double kick_bodies(ContactTile& c, std::size_t i, bool touching,
                                                 const Touch& t, const StepUnits& u) {
  const double fx = touching ? t.fx : 0.0, fy = touching ? t.fy : 0.0;
  const double x = fx * (c.per_mass[0][i] * u.kick_x);
  const double y = fy * (c.per_mass[0][i] * u.kick_y);
  c.kick[0][i] = {Numbers::whole(x), Numbers::whole(y)};
  double size = std::abs(x) + std::abs(y);
  if constexpr (partner == Partner::grain) {
    const double other_x = -fx * (c.per_mass[1][i] * u.kick_x);
    const double other_y = -fy * (c.per_mass[1][i] * u.kick_y);
    c.kick[1][i] = {Numbers::whole(other_x), Numbers::whole(other_y)};
    size += std::abs(other_x) + std::abs(other_y);
  }
  return size;
}

/// The same for the torques, where bodies rotate; else returns 0.
template <class Numbers, Partner partner, class Turn>
[[gnu::always_inline]] inline double twist_bodies(ContactTile& c, std::size_t i, bool touching,
                                                  const Turn& turn, const Touch& t,
                                                  const StepUnits& u) {
  double size = 0.0;
  if constexpr (std::is_same_v<Turn, Turning>) {
    const double torque = touching ? t.torque : 0.0;
    const double rolling = touching ? t.rolling_torque : 0.0;
    const double first =
        (turn.part_first * torque + rolling) * turn.per_inertia_first * u.spin_kick;
    c.spin_kick[0][i] = Numbers::whole(first);
    size = std::abs(first);
    if constexpr (partner == Partner::grain) {
      const double second =
          (turn.part_second * torque - rolling) * turn.per_inertia_second * u.spin_kick;
      c.spin_kick[1][i] = Numbers::whole(second);
      size += std::abs(second);
    }
  }
  return size;
}

/// One step of the contacts in `blocks` blocks of LaneMasks<Mask>::lanes lanes: whole tiles, or the
/// first half of the only one. Lanes that do not touch compute nonsense, which is discarded.
template <Partner partner, class Turn>
struct StepLoop {
  template <class Numbers, class Mask, class Normal, class Slip>
  [[gnu::always_inline]] static void run(ContactTile* tiles, std::size_t blocks, Mask* block_masks,
                                         const Bodies& bodies, const StepUnits& units,
                                         Normal normal, Slip slip, double mu,
                                         double rolling_friction, Attraction attraction) {
    using Masks = LaneMasks<Mask>;
    // Copies, of which only what is used is loaded, and once: through the references it would have
    // to be loaded again after each store.
    const Bodies b = bodies;
    const StepUnits u = units;
    for (std::size_t block = 0; block < blocks; ++block) {
      ContactTile& c = tiles[block];
      Mask mask = 0;
#pragma omp simd reduction(| : mask)
      for (std::size_t i = 0; i < Masks::lanes; ++i) {
        const Encounter e = next_encounter<Numbers, partner>(c, i, b, u);
        const bool touching = e.x * e.x + e.y * e.y < e.reach * e.reach;
        const Turn turn = turning_of<Numbers, partner, Turn>(c, i, b, rolling_friction, u);
        const Touch t =
            touch(e, turn, stretch_of<Slip>(c, i, u), normal, slip, mu, attraction, u.dt);
        carry_on<partner>(c, i, touching, e, turn, t, slip, u);
        const double size = kick_bodies<Numbers, partner>(c, i, touching, t, u)
                            + twist_bodies<Numbers, partner>(c, i, touching, turn, t, u);
        // NaN, or a number that no 64-bit integer holds, must not be converted to a kick.
        const Mask bad = size < 0x1p62 ? 0 : 1;
        const Mask over = touching ? 0 : 1;
        mask |= Masks::bit_if(over, i, ContactFindings::apart)
                | Masks::bit_if(bad, i, ContactFindings::unusable);
      }
      block_masks[block] = mask;
    }
  }
};

/// Gives the contacts the last kicks of their grains; in a scalar loop, as vector gathers are
/// slower. Contacts that have been added since the last step also get the relative motion of their
/// grains, taken back by one step.
void follow_bodies(std::span<ContactTile> tiles, const ContactCounts& counts,
                   const Bodies& bodies) {
  const Bodies b = bodies;
  for_each_lane(tiles, 0, counts.all, [&](ContactTile& c, std::size_t i) {
    const std::int64_t first = c.body[0][i], second = c.body[1][i];
    c.partner.kick.set(i, wrapped_difference(b.kick[second], b.kick[first]));
  });
  for_each_lane(tiles, counts.followed, counts.all, [&](ContactTile& c, std::size_t i) {
    const BodyMotion now = relative_motion(b, c.body[0][i], c.body[1][i]);
    c.partner.position.set(i, wrapped_difference(now.position, now.u));
    c.partner.u.set(i, wrapped_difference(now.u, now.kick));
  });
}

template <Partner partner, class Turn, class Normal, class Slip>
void step_tiles(std::span<ContactTile> tiles, const ContactCounts& counts, const Bodies& bodies,
                const StepUnits& units, const ContactModel& model, const Normal& normal,
                const Slip& slip, ContactFindings& found) {
  if constexpr (partner == Partner::grain) follow_bodies(tiles, counts, bodies);
  for_each_lane(tiles, counts.lasting, counts.all, [&](ContactTile& c, std::size_t i) {
    const Touch t = touch(encounter_of<ByConversion, partner>(c, i, bodies, units),
                          turning_of<ByConversion, partner, Turn>(c, i, bodies, 0.0, units),
                          Stretch{.spring = 0.0, .time = 0.0}, normal, slip, model.friction,
                          model.attraction, units.dt);
    c.life[RIESEL_LIFE(begin)][i] = units.time - t.since;
    c.life[RIESEL_LIFE(entry_rate)][i] = t.rate;
    c.life[RIESEL_LIFE(entry_slip)][i] = t.centre_slip;
  });
  found.with_masks(counts.all, [&](auto& masks) {
    run_vector_loop<StepLoop<partner, Turn>>(
        tiles.data(), masks.blocks(counts.all), masks.of_blocks.data(), bodies, units, normal, slip,
        model.friction, model.rolling_friction, model.attraction);
  });
}

template <Partner partner>
void step_tiles(std::span<ContactTile> tiles, const ContactCounts& counts, const Bodies& bodies,
                const StepUnits& units, const ContactModel& model, ContactFindings& found) {
  std::visit(
      [&](const auto& normal, const auto& slip) {
        if (bodies.rotate())
          step_tiles<partner, Turning>(tiles, counts, bodies, units, model, normal, slip, found);
        else
          step_tiles<partner, NoTurning>(tiles, counts, bodies, units, model, normal, slip, found);
      },
      model.normal, model.slip);
}

}  // namespace

void step_tiles(Partner partner, std::span<ContactTile> tiles, const ContactCounts& counts,
                const Bodies& bodies, const StepUnits& units, const ContactModel& model,
                ContactFindings& found) {
  if (partner == Partner::grain)
    step_tiles<Partner::grain>(tiles, counts, bodies, units, model, found);
  else
    step_tiles<Partner::wall>(tiles, counts, bodies, units, model, found);
}

void add_last_loss(Contact& contact, const Meeting& meeting, const Bodies& bodies,
                   const SlipLaw& slip, const StepUnits& units) {
  const auto life = [so_far = life_of(contact)](std::size_t member) { return so_far[member]; };
  const Encounter e = encounter(meeting, bodies, units);
  contact.friction_loss += std::visit(
      [&](const auto& law) {
        return bodies.rotate()
                   ? loss_before(life, e, turning(meeting, bodies, 0.0, units), law, 0.0, units.dt)
                   : loss_before(life, e, NoTurning{}, law, 0.0, units.dt);
      },
      slip);
}

}  // namespace riesel
