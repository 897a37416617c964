#include "engine/observables.hpp"

#include "engine/exact_sums.hpp"
#include "engine/vector_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace riesel {

namespace {

/// Sums over all grains.
struct GrainSums {
  double vx, vy, vx2, vy2, mass, momentum_y, kinetic, moment_x;
  std::int64_t outside;
};

/// m, the range of x between the lines of the walls where these are now; infinite on a side without
/// a wall.
struct Gap {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();

  bool is_beyond(double x) const { return x < low || x > high; }
};

Gap between_walls(const State& state) {
  Gap gap;
  for (const WallLattice& wall : state.walls)
    (wall.inwards(state.box) > 0.0 ? gap.low : gap.high) =
        wall.line + wall.motion.way(state.box, state.time()).x;
  return gap;
}

RIESEL_VECTOR_KERNEL GrainSums sum_over_grains(const State& state) {
  ExactSums<8> sums;
  std::int64_t outside = 0;
  const Gap room = between_walls(state);
  const GrainView grains(state);
  std::array<std::array<double, 8>, 32> terms;
  for (std::size_t first = 0; first < state.grains.size(); first += terms.size()) {
    const std::size_t count = std::min(terms.size(), state.grains.size() - first);
    for (std::size_t i = 0; i < count; ++i) {
      const Grain g = grains[first + i];
      const double vx2 = g.vx * g.vx, vy2 = g.vy * g.vy;
      terms[i] = {g.vx,        g.vy, vx2, vy2, g.mass, g.mass * g.vy, 0.5 * g.mass * (vx2 + vy2),
                  g.mass * g.x};
      if (room.is_beyond(g.x)) ++outside;
    }
    for (std::size_t i = 0; i < count; ++i) sums.add(terms[i]);
  }
  const auto value = [&](std::size_t i) { return sums.sum(i).value(); };
  return {value(0), value(1), value(2), value(3), value(4), value(5), value(6), value(7), outside};
}

/// Sums over all grains; 0 if they do not rotate.
struct SpinSums {
  double spin, temperature, energy;
};

SpinSums sum_over_spins(const State& state) {
  ExactSum temperature, energy;
  Int128 half_quanta = 0;  // of angle per step: spins of small grains may exceed ExactSum's range
  const GrainView grains(state);
  for (std::size_t i = 0; state.grains.rotate() && i < state.grains.size(); ++i) {
    const Grain g = grains[i];
    const double surface_speed = g.radius * g.spin;
    const double twice_per_mass = state.grains.inertia * (surface_speed * surface_speed);
    half_quanta += 2 * Int128{state.grains.spin[i]} + state.grains.spin_kick[i];
    temperature.add(twice_per_mass);
    energy.add(0.5 * g.mass * twice_per_mass);
  }
  const double spin = static_cast<double>(half_quanta) * (0.5 * quantum_of_angle / state.time_step);
  return {spin, temperature.value(), energy.value()};
}

/// The tally of contacts with walls, or of those between grains, to which the present contacts are
/// added as if they ended now.
ContactTally all_contacts(const State& state, bool of_walls) {
  ContactTally sum = of_walls ? state.tally.walls : state.tally.grains;
  for (const Contact& contact : state.contacts)
    if ((contact.name.wall != no_wall) == of_walls) sum.add(contact);
  return sum;
}

/// The impulses of the walls, with what the present contacts have given so far.
WallImpulses all_impulses(const State& state) {
  WallImpulses impulses = state.tally.impulses;
  for (const Contact& contact : state.contacts)
    if (contact.name.wall != no_wall) impulses.add(contact);
  return impulses;
}

/// J. Across the tube it follows from the positions of the grains. Along the tube these do not tell
/// how often grains have gone round; but contacts between grains do not change the momentum, so the
/// displacement of the centre of mass follows from the momentum at the start, from free fall, and
/// from the impulses of the walls: one given at time s has acted for t - s.
double work_of_gravity(const State& state, const GrainSums& sums, const ContactTally& walls) {
  const double t = state.time();
  const double mass_times_way =
      state.origin.momentum_y * t + 0.5 * sums.mass * state.gravity.y * t * t
      + t * walls.impulse_y.value() - ContactTally::era * walls.impulse_y_times_time.value();
  return state.gravity.y * mass_times_way
         + state.gravity.x * (sums.moment_x - state.origin.moment_x);
}

double stored_energy(const State& state) {
  ExactSum sum;
  for (const Contact& contact : state.contacts) sum.add(contact.elastic_energy);
  return sum.value();
}

/// kg m/s along y: half of the present kicks. Velocities at the full step include only the other
/// half, but the motion goes on with all of it. Kicks of grains on each other cancel in the sum.
double half_of_kicks(const State& state) {
  ExactSum sum;
  for (std::size_t i = 0; i < state.grains.size(); ++i)
    sum.add(0.5 * state.grains.mass[i] * state.box.metres_y(state.grains.kick[i].y)
            / state.time_step);
  return sum.value();
}

/// Standard deviation of n values, from their sum and the sum of their squares.
double standard_deviation(double sum, double sum_of_squares, double n) {
  const double mean = sum / n;
  return std::sqrt(std::max(0.0, sum_of_squares / n - mean * mean));
}

}  // namespace

Origin origin_of(const State& state) {
  const GrainSums sums = sum_over_grains(state);
  return {.energy = sums.kinetic + sum_over_spins(state).energy + stored_energy(state),
          .momentum_y = sums.momentum_y + half_of_kicks(state),
          .moment_x = sums.moment_x};
}

std::optional<std::int32_t> grain_outside(const State& state) {
  const Gap room = between_walls(state);
  const GrainView grains(state);
  std::optional<std::int32_t> first;
  for (std::size_t slot = 0; slot < state.grains.size(); ++slot)
    if (room.is_beyond(grains[slot].x))
      first = std::min(first.value_or(INT32_MAX), state.grains.id[slot]);
  return first;
}

FastestGrain fastest_grain(const State& state) {
  FastestGrain fastest;
  const GrainView grains(state);
  for (std::size_t slot = 0; slot < state.grains.size(); ++slot) {
    const Grain g = grains[slot];
    const double speed = std::hypot(g.vx, g.vy);
    const std::int32_t id = state.grains.id[slot];
    if (speed > fastest.speed || (speed == fastest.speed && id < fastest.id)) fastest = {speed, id};
  }
  return fastest;
}

namespace {

/// The part of largest_sum() over grains, by sums in floating point, which cannot wrap.
double largest_sum_over_grains(const State& state) {
  double mass = 0.0, moment = 0.0, kinetic = 0.0;
  const GrainView grains(state);
  for (std::size_t slot = 0; slot < state.grains.size(); ++slot) {
    const Grain g = grains[slot];
    const double at_surface = g.radius * g.spin;
    mass += g.mass;
    moment += g.mass * std::abs(g.x);
    kinetic +=
        0.5 * g.mass * (g.vx * g.vx + g.vy * g.vy + state.grains.inertia * at_surface * at_surface);
  }
  return std::max({mass, moment, kinetic});
}

/// The part over the present contacts. The elastic force times the distance is about twice the
/// elastic energy times the distance over the overlap.
double largest_sum_over_contacts(const State& state) {
  const auto& radii = state.grains.radius;
  const double distance = radii.empty() ? 0.0 : 2.0 * *std::ranges::max_element(radii);
  double energy = 0.0, virial = 0.0;
  for (const Contact& contact : state.contacts) {
    energy += contact.elastic_energy;
    if (contact.overlap > 0.0) virial += 2.0 * contact.elastic_energy * distance / contact.overlap;
  }
  return std::max(energy, virial);
}

}  // namespace

double largest_sum(const State& state) {
  double largest = std::max(largest_sum_over_grains(state), largest_sum_over_contacts(state));
  const auto look_at = [&](const ExactSum& sum) {
    largest = std::max(largest, std::abs(sum.value()));
  };
  const Tally& t = state.tally;
  for (const ContactTally* kind : {&t.grains, &t.walls})
    for (const auto member :
         {&ContactTally::normal_loss, &ContactTally::friction_loss, &ContactTally::energy_won,
          &ContactTally::impulse_y, &ContactTally::impulse_y_times_time})
      look_at(kind->*member);
  for (const auto* of_walls : {&t.impulses.x, &t.impulses.y})
    for (const ExactSum& of_wall : *of_walls) look_at(of_wall);
  look_at(t.impulses.work);
  look_at(t.brakes.braking);
  return largest;
}

double largest_speed(const Box& box, double time_step, std::size_t grains) {
  constexpr double range = ExactSum::largest_sum;  // (m/s)^2
  return std::min(0.125 * std::min(box.width, box.length) / time_step,
                  std::sqrt(range / static_cast<double>(grains)));
}

namespace {

Energies energies_of(const State& state, const GrainSums& sums, const SpinSums& spins,
                     const ContactTally& among_grains, const ContactTally& at_walls) {
  Energies e;
  e.kinetic = sums.kinetic;
  e.rotational = spins.energy;
  e.elastic = stored_energy(state);
  e.gravity_work = work_of_gravity(state, sums, at_walls);
  e.wall_work = state.tally.impulses.work.value();
  e.normal_loss = among_grains.normal_loss.value() + at_walls.normal_loss.value();
  e.friction_loss = among_grains.friction_loss.value() + at_walls.friction_loss.value();
  e.won = among_grains.energy_won.value() + at_walls.energy_won.value();
  e.residual = state.origin.energy + e.gravity_work + e.wall_work - e.kinetic - e.rotational
               - e.elastic - e.normal_loss - e.friction_loss;
  return e;
}

}  // namespace

Observables observe(const State& state) {
  const GrainSums sums = sum_over_grains(state);
  const SpinSums spins = sum_over_spins(state);
  const ContactTally among_grains = all_contacts(state, false);
  const ContactTally at_walls = all_contacts(state, true);
  const auto n = static_cast<double>(state.grains.size());

  Observables o;
  o.time = state.time();
  o.mean_vx = sums.vx / n;
  o.mean_vy = sums.vy / n;
  o.sigma_vx = standard_deviation(sums.vx, sums.vx2, n);
  o.sigma_vy = standard_deviation(sums.vy, sums.vy2, n);
  o.granular_temperature = 0.5 * (o.sigma_vx * o.sigma_vx + o.sigma_vy * o.sigma_vy);
  o.mean_spin = spins.spin / n;
  o.rotational_temperature = spins.temperature / n;
  o.energies = energies_of(state, sums, spins, among_grains, at_walls);
  o.contacts = static_cast<double>(state.contacts.size()) / n;
  o.grain_contacts_begun = static_cast<double>(among_grains.begun);
  o.wall_contacts_begun = static_cast<double>(at_walls.begun);
  o.wall_impulse_y = at_walls.impulse_y.value();
  const WallImpulses impulses = all_impulses(state);
  std::ranges::transform(impulses.x, o.impulse_x_of_wall.begin(), &ExactSum::value);
  std::ranges::transform(impulses.y, o.impulse_y_of_wall.begin(), &ExactSum::value);
  o.max_overlap = std::max(among_grains.max_overlap, at_walls.max_overlap);
  o.outside = static_cast<double>(sums.outside);
  o.structure_factor = axial_structure_factor(state.grains);
  return o;
}

LargestOverlap largest_overlap(const State& state) {
  const auto& radii = state.grains.radius;
  const double smallest = *std::min_element(radii.begin(), radii.end());
  double smallest_at_wall = smallest;
  for (const WallLattice& wall : state.walls)
    smallest_at_wall = wall.smaller_radius(smallest_at_wall);
  const auto largest = [&](bool at_wall, double radius) {
    const ContactTally all = all_contacts(state, at_wall);
    return LargestOverlap{all.max_overlap, all.max_overlap / radius, all.deepest};
  };
  const LargestOverlap of_grains = largest(false, smallest);
  const LargestOverlap of_walls = largest(true, smallest_at_wall);
  return of_walls.ratio > of_grains.ratio ? of_walls : of_grains;
}

double energy_turned_over(double initial, double gravity_work, double wall_work) {
  return initial + std::abs(gravity_work) + std::abs(wall_work);
}

double energy_error_ratio(const State& state, const Energies& energies) {
  const double error = std::abs(energies.residual) + energies.won;
  if (error == 0.0) return 0.0;
  return error / energy_turned_over(state.origin.energy, energies.gravity_work, energies.wall_work);
}

}  // namespace riesel
