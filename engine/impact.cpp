#include "engine/impact.hpp"

#include "engine/closed_forms.hpp"
#include "engine/hash.hpp"
#include "engine/observables.hpp"
#include "engine/parallel_problems.hpp"
#include "engine/require.hpp"
#include "engine/run_failure.hpp"
#include "engine/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace riesel {

namespace {

/// Whether an impact is over is checked after this many steps, or sooner if a fast grain may go
/// this many reaches in fewer: it must not leave the box, which would end the run.
constexpr std::int64_t most_steps_between_looks = 16;
constexpr double reaches_between_looks = 8.0;

/// An impact is given up after the time to get to the wall, plus this many collision times, plus
/// the time to go this many reaches.
constexpr double patience_in_collisions = 2000.0;
constexpr double patience_in_reaches = 50.0;

/// Period along y (and width) of the box: so long that the images of a single wall grain are far.
constexpr double period_in_reaches = 64.0;

State start(const ImpactSetup& setup, const Impact& impact) {
  const double scale = greatest_height(setup);
  State state;
  std::int64_t wall_grains = 1;
  double length = scale;
  if (!setup.single_wall_grain()) {
    wall_grains = std::llround(std::ceil(scale / setup.wall_spacing));
    length = static_cast<double>(wall_grains) * setup.wall_spacing;
  }
  state.box = {.width = scale, .length = length};
  state.walls = {{.line = 0.0, .radius = setup.wall_grain_radius, .count = wall_grains}};
  state.time_step = impact.time_step;
  state.grains.inertia = setup.inertia;
  add_grain(state, {.x = impact.x,
                    .y = impact.y,
                    .vx = -impact.v_x,
                    .vy = impact.v_y,
                    .radius = setup.grain_radius,
                    .mass = setup.grain_mass});
  return state;
}

double speed_of(const Impact& impact) { return std::hypot(impact.v_x, impact.v_y); }

std::int64_t steps_between_looks(const ImpactSetup& setup, const Impact& impact) {
  const double steps =
      reaches_between_looks * setup.reach() / (speed_of(impact) * impact.time_step);
  const auto most = static_cast<double>(most_steps_between_looks);
  return static_cast<std::int64_t>(std::clamp(steps, 1.0, most));
}

/// Whether the grain can never touch the wall again.
bool gone(const ImpactSetup& setup, const State& state, const Grain& grain) {
  if (!state.contacts.empty()) return false;
  if (!setup.single_wall_grain()) return grain.x > setup.reach() && grain.vx > 0.0;
  const double y = state.box.metres_y(state.grains.position[0].y);  // relative to the wall grain
  return grain.x * grain.vx + y * grain.vy > 0.0;
}

/// s, the time that the grain takes to the line of the wall in free flight: an upper bound of the
/// time to the first contact.
double time_to_wall(const ImpactSetup& setup, const Impact& impact) {
  if (setup.single_wall_grain()) return std::hypot(impact.x, impact.y) / speed_of(impact);
  return impact.v_x > 0.0 ? impact.x / impact.v_x : 0.0;
}

}  // namespace

double greatest_height(const ImpactSetup& setup) { return period_in_reaches * setup.reach(); }

double just_upstream(const ImpactSetup& setup, double x) {
  constexpr double gap = 1e-3;  // of the reach: no contact yet
  require(std::abs(x) <= setup.reach(), "a grain that passes the wall grain by does not touch it");
  const double distance = (1.0 + gap) * setup.reach();
  return -std::sqrt(distance * distance - x * x);
}

namespace {

ImpactEnd advance_to_the_end(Simulation& simulation, const ImpactSetup& setup,
                             const Impact& impact) {
  const double patience = time_to_wall(setup, impact)
                          + patience_in_collisions * setup.collision_time
                          + patience_in_reaches * setup.reach() / speed_of(impact);
  const std::int64_t steps = steps_between_looks(setup, impact);
  while (simulation.state().time() < patience) {
    simulation.advance(steps);
    const Grain grain = grain_at(simulation.state(), 0);
    if (grain.x < -setup.reach()) return ImpactEnd::passed;
    if (gone(setup, simulation.state(), grain)) return ImpactEnd::away;
  }
  return ImpactEnd::stuck;
}

}  // namespace

ImpactResult follow(const ImpactSetup& setup, const Impact& impact) {
  require(speed_of(impact) > 0.0, "an impact needs a velocity");
  Simulation simulation(start(setup, impact), setup.model, 1);
  const ImpactEnd end = advance_to_the_end(simulation, setup, impact);
  const State& state = simulation.state();
  const Grain grain = grain_at(state, 0);
  const ContactTally& tally = state.tally.walls;
  const BrakeTally& brakes = state.tally.brakes;
  const Observables now = observe(state);  // with contacts that last
  return {.dv_x = grain.vx + impact.v_x,
          .dv_y = impact.v_y - grain.vy,
          .contacts = static_cast<double>(tally.begun),
          .contact_time = tally.duration.value(),
          .max_overlap = now.max_overlap,
          .cut_short = static_cast<double>(brakes.cut_short),
          .braking = brakes.braking.value(),
          .braking_cut_short = brakes.braking_cut_short.value(),
          .energy_error = energy_error_ratio(state, now.energies),
          .end = end,
          .steps = state.step};
}

std::vector<ImpactResult> follow_all(const ImpactSetup& setup, const std::vector<Impact>& impacts,
                                     int threads) {
  return solve_all(impacts, threads, [&](const Impact& impact) { return follow(setup, impact); });
}

namespace {

/// The head-on impact of a body of the reduced mass, with radii so large that the overlap is small
/// against them.
ImpactSetup head_on(const ContactModel& model, double reduced_mass, double speed) {
  constexpr double radius_in_overlaps = 20.0;
  const ElasticLine line = elastic_line(model.normal);
  const double radius = radius_in_overlaps * elastic_max_overlap(line, reduced_mass, speed);
  return {.grain_radius = radius,
          .grain_mass = reduced_mass,
          .wall_grain_radius = radius,
          .wall_spacing = 0.0,
          .model = model,
          .collision_time = elastic_collision_time(line, reduced_mass, speed)};
}

}  // namespace

std::optional<double> restitution(const ContactModel& model, double reduced_mass, double speed) {
  constexpr double steps_per_contact = 400.0, gap = 1e-3;
  constexpr double least_restitution = 1e-3, most_error = 0.01;
  const ImpactSetup setup = head_on(model, reduced_mass, speed);
  const Impact impact{.x = (1.0 + gap) * setup.reach(),
                      .y = 0.0,
                      .v_x = speed,
                      .v_y = 0.0,
                      .time_step = setup.collision_time / steps_per_contact};
  try {
    const ImpactResult result = follow(setup, impact);
    const double restitution = result.dv_x / speed - 1.0;
    // Overdamped bodies creep apart, or are pushed apart by errors of steps too long for them.
    const bool rebounds = result.end == ImpactEnd::away && restitution > least_restitution
                          && result.energy_error < most_error;
    return rebounds ? std::optional(restitution) : std::nullopt;
  } catch (const RunFailure&) {
    return {};  // the steps are too long for the damping
  }
}

std::uint64_t hash_of(const std::vector<ImpactResult>& results) {
  Hash hash;
  for (const ImpactResult& r : results) {
    for (const double value : {r.dv_x, r.dv_y, r.contacts, r.contact_time, r.max_overlap,
                               r.cut_short, r.braking, r.braking_cut_short, r.energy_error})
      hash.add(value);
    hash.add(static_cast<std::int64_t>(r.end));
    hash.add(r.steps);
  }
  return hash.value();
}

}  // namespace riesel
