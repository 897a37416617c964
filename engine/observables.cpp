#include "engine/observables.hpp"

#include <algorithm>
#include <cmath>

namespace riesel {

namespace {

/// Sums over all grains.
struct GrainSums {
  ExactSum vx, vy, vx2, vy2, mass, momentum_y, kinetic;
  std::int64_t outside = 0;
};

GrainSums sum_over_grains(const State& state) {
  GrainSums sums;
  const GrainView grains(state);
  for (std::size_t slot = 0; slot < state.grains.size(); ++slot) {
    const Grain g = grains[slot];
    sums.vx.add(g.vx);
    sums.vy.add(g.vy);
    sums.vx2.add(g.vx * g.vx);
    sums.vy2.add(g.vy * g.vy);
    sums.mass.add(g.mass);
    sums.momentum_y.add(g.mass * g.vy);
    sums.kinetic.add(0.5 * g.mass * (g.vx * g.vx + g.vy * g.vy));
    if (g.x < 0.0 || g.x > state.box.width) ++sums.outside;
  }
  return sums;
}

/// The tally with the lasting contacts in it, as if they ended now.
ContactTally all_contacts(const State& state, bool of_walls) {
  ContactTally sum = of_walls ? state.tally.walls : state.tally.grains;
  for (const Contact& contact : state.contacts)
    if ((contact.name.wall != no_wall) == of_walls) sum.add(contact);
  return sum;
}

/// With what the lasting contacts have given so far.
WallImpulses all_impulses(const State& state) {
  WallImpulses impulses = state.tally.impulses;
  for (const Contact& contact : state.contacts)
    if (contact.name.wall != no_wall) impulses.add(contact);
  return impulses;
}

/// J. Contacts between grains do not change the momentum, so the way of the centre of mass follows
/// from its start, from free fall, and from the impulses of the walls, of which one given at step s
/// acts in n - s steps.
double work_of_gravity(const State& state, double mass, const ContactTally& walls) {
  const auto n = static_cast<double>(state.step);
  const double t = state.time();
  const double mass_times_way =
      state.origin.momentum_y * t + 0.5 * mass * state.gravity * t * t
      + state.time_step * (n * walls.impulse_y.value() - walls.impulse_y_times_step.value());
  return state.gravity * mass_times_way;
}

double stored_energy(const State& state) {
  ExactSum sum;
  for (const Contact& contact : state.contacts) sum.add(contact.elastic_energy);
  return sum.value();
}

/// Of n values, from their sum and the sum of their squares.
double standard_deviation(double sum, double sum_of_squares, double n) {
  const double mean = sum / n;
  return std::sqrt(std::max(0.0, sum_of_squares / n - mean * mean));
}

}  // namespace

Origin origin_of(const State& state) {
  const GrainSums sums = sum_over_grains(state);
  return {.energy = sums.kinetic.value() + stored_energy(state),
          .momentum_y = sums.momentum_y.value()};
}

Observables observe(const State& state) {
  const GrainSums sums = sum_over_grains(state);
  const ContactTally among_grains = all_contacts(state, false);
  const ContactTally at_walls = all_contacts(state, true);
  const auto n = static_cast<double>(state.grains.size());

  Observables o;
  o.time = state.time();
  o.mean_vx = sums.vx.value() / n;
  o.mean_vy = sums.vy.value() / n;
  o.sigma_vx = standard_deviation(sums.vx.value(), sums.vx2.value(), n);
  o.sigma_vy = standard_deviation(sums.vy.value(), sums.vy2.value(), n);
  o.granular_temperature = 0.5 * (o.sigma_vx * o.sigma_vx + o.sigma_vy * o.sigma_vy);
  o.energies.kinetic = sums.kinetic.value();
  o.energies.elastic = stored_energy(state);
  o.energies.gravity_work = work_of_gravity(state, sums.mass.value(), at_walls);
  o.energies.normal_loss = among_grains.normal_loss.value() + at_walls.normal_loss.value();
  o.energies.friction_loss = among_grains.friction_loss.value() + at_walls.friction_loss.value();
  o.energies.residual = state.origin.energy + o.energies.gravity_work - o.energies.kinetic
                        - o.energies.elastic - o.energies.normal_loss - o.energies.friction_loss;
  o.contacts = static_cast<double>(state.contacts.size()) / n;
  o.grain_contacts_begun = static_cast<double>(among_grains.begun);
  o.wall_contacts_begun = static_cast<double>(at_walls.begun);
  o.wall_impulse_y = at_walls.impulse_y.value();
  std::ranges::transform(all_impulses(state).y, o.impulse_y_of_wall.begin(), &ExactSum::value);
  o.max_overlap = std::max(among_grains.max_overlap, at_walls.max_overlap);
  o.outside = static_cast<double>(sums.outside);
  o.structure_factor = axial_structure_factor(state.grains);
  return o;
}

}  // namespace riesel
