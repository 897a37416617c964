#include "engine/bead_column.hpp"

#include "engine/hash.hpp"
#include "engine/observables.hpp"
#include "engine/parallel_problems.hpp"
#include "engine/require.hpp"

#include <algorithm>
#include <cmath>

namespace riesel {

namespace {

/// Whether a drop is over is checked after every so many steps.
constexpr std::int64_t steps_between_looks = 1024;

/// A drop is given up after this many collision times per bead, plus the time to go this many
/// heights of the column.
constexpr double patience_in_collisions = 200.0;
constexpr double patience_in_heights = 1000.0;

/// Distance of the lowest bead from the plate at the start, over the gap between beads: small, to
/// save steps.
constexpr double first_gap = 0.1;

double height(const ColumnSetup& setup, double gap) {
  return setup.beads * (2.0 * setup.bead_radius + gap);
}

double patience(const ColumnSetup& setup, double gap) {
  return patience_in_collisions * setup.beads * setup.collision_time
         + patience_in_heights * height(setup, gap) / setup.velocity;
}

State start(const ColumnSetup& setup, double gap) {
  const double diameter = 2.0 * setup.bead_radius;
  // Wide enough for beads that fly away until the drop is given up: none gets much faster than the
  // column fell.
  const double room = height(setup, gap) + 4.0 * patience(setup, gap) * setup.velocity;
  State state;
  state.box = {.width = room, .length = 8.0 * diameter};
  state.walls = {{.line = 0.0, .radius = setup.bead_radius, .count = 1}};
  state.time_step = setup.time_step;
  for (int i = 0; i < setup.beads; ++i)
    add_grain(state, {.x = (i + 1) * diameter + (i + first_gap) * gap,
                      .y = 0.0,
                      .vx = -setup.velocity,
                      .vy = 0.0,
                      .radius = setup.bead_radius,
                      .mass = setup.bead_mass});
  return state;
}

/// m/s, positive upwards, from the lowest bead to the highest.
std::vector<double> velocities(const State& state) {
  const GrainView grains(state);
  std::vector<double> v;
  for (const std::size_t slot : slots_by_id(state.grains)) v.push_back(grains[slot].vx);
  return v;
}

/// Whether no contact is left, and no two neighbours approach noticeably: others would meet late
/// and lose next to nothing.
bool is_over(const ColumnSetup& setup, const State& state) {
  constexpr double hardly = 1e-3;  // of the present velocities: 1e-6 of the energy
  constexpr double slowly = 1e-3;  // of the velocity at the start: 1e-6 of that energy
  if (!state.contacts.empty()) return false;
  double squares = 0.0, largest_approach = 0.0, below = 0.0;  // `below` is the plate at first
  const std::vector<double> velocity = velocities(state);
  for (const double v : velocity) {
    squares += v * v;
    largest_approach = std::max(largest_approach, below - v);
    below = v;
  }
  return largest_approach
         <= std::max(hardly * std::sqrt(squares / setup.beads), slowly * setup.velocity);
}

ColumnResult result(const ColumnSetup& setup, const State& state, bool over) {
  double sum = 0.0, squares = 0.0;
  for (const double v : velocities(state)) {
    sum += v;
    squares += v * v;
  }
  const ContactTally &pairs = state.tally.grains, &plate = state.tally.walls;
  const Observables now = observe(state);  // with contacts that last
  return {.restitution = std::sqrt(squares / setup.beads) / setup.velocity,
          .rebound = sum / setup.beads / setup.velocity,
          .contacts = static_cast<double>(pairs.begun + plate.begun),
          .contact_time = pairs.duration.value() + plate.duration.value(),
          .max_overlap = now.max_overlap,
          .energy_error = energy_error_ratio(state, now.energies),
          .over = over,
          .steps = state.step};
}

}  // namespace

ColumnResult drop(const ColumnSetup& setup, double gap, Stepping stepping) {
  require(setup.beads > 0 && setup.velocity > 0.0, "a column needs beads and a velocity");
  Simulation simulation(start(setup, gap), setup.model, 1, stepping);
  const double longest = patience(setup, gap);
  bool over = false;
  // A bead beyond the centre of the plate has passed through it and is never driven back.
  while (!over && !grain_outside(simulation.state()) && simulation.state().time() < longest) {
    simulation.advance(steps_between_looks);
    over = is_over(setup, simulation.state());
  }
  return result(setup, simulation.state(), over);
}

std::vector<ColumnResult> drop_all(const ColumnSetup& setup, const std::vector<double>& gaps,
                                   int threads) {
  return solve_all(gaps, threads, [&](double gap) { return drop(setup, gap); });
}

std::uint64_t hash_of(const std::vector<ColumnResult>& results) {
  Hash hash;
  for (const ColumnResult& r : results) {
    for (const double value :
         {r.restitution, r.rebound, r.contacts, r.contact_time, r.max_overlap, r.energy_error})
      hash.add(value);
    hash.add(std::int64_t{r.over});
    hash.add(r.steps);
  }
  return hash.value();
}

}  // namespace riesel
