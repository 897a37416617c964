#include "app/flow_summary.hpp"

#include "app/cumulative.hpp"
#include "app/steadiness.hpp"
#include "app/wall_forces.hpp"
#include "engine/time_series.hpp"
#include "engine/typical_contacts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace riesel::app {

namespace {

/// Mean of one series from row `first` on, which is the end of the transient.
io::Measured mean_of(const io::RunFile& file, const std::string& name, std::size_t first) {
  const std::vector<double> series = file.series(name);
  const Estimate mean = mean_with_error(std::span(series).subspan(first));
  return {.value = mean.value, .error = mean.error};
}

io::FlowSummary::Fluctuations fluctuations_of(const io::RunFile& file, std::size_t first) {
  return {.sigma_vx = mean_of(file, "sigma_vx", first),
          .sigma_vy = mean_of(file, "sigma_vy", first),
          .granular_temperature = mean_of(file, "granular_temperature", first)};
}

std::array<io::Measured, density_waves> structure_factors_of(const io::RunFile& file,
                                                             std::size_t first) {
  std::array<io::Measured, density_waves> factors{};
  for (std::size_t n = 1; n <= density_waves; ++n)
    factors[n - 1] = mean_of(file, "structure_factor_" + std::to_string(n), first);
  return factors;
}

/// Means over the core of the tube, and over the layers at the walls.
std::pair<io::FlowSummary::Zone, io::FlowSummary::Zone>
zones(const TimeBlocks& blocks, const Strips& strips, std::size_t walls, std::int64_t first) {
  const auto profiles =
      tube_profiles(blocks, strips, {core_of(strips), wall_layers_of(strips, walls)}, first);
  const auto zone = [&](std::size_t i) {
    const auto measured = [&](std::string_view name) {
      const auto found = std::ranges::find(profiles, name, &TubeProfile::name);
      return found->zones[i];
    };
    return io::FlowSummary::Zone{.area_fraction = measured("area_fraction"),
                                 .mean_axial_velocity = measured("mean_axial_velocity"),
                                 .temperature_x = measured("temperature_x"),
                                 .temperature_y = measured("temperature_y"),
                                 .stress_xx = measured("stress_xx"),
                                 .stress_yy = measured("stress_yy"),
                                 .stress_xy = measured("stress_xy"),
                                 .shear_rate = measured("shear_rate"),
                                 .mean_spin = measured("mean_spin"),
                                 .rotational_temperature = measured("rotational_temperature")};
  };
  return {zone(0), zone(1)};
}

io::Measured scaled(const io::Measured& m, double factor) {
  return {.value = factor * m.value + 0.0, .error = std::abs(factor) * m.error};  // no -0
}

/// Eq. (9). `along`: forces of the walls.
io::FlowSummary::Balance balance(const CumulativeSeries& series, const State& state,
                                 const WallForces& along) {
  const auto n = static_cast<double>(state.grains.size());
  const double mass = total_mass(state.grains);
  io::FlowSummary::Balance b{.n_dot = scaled(series.rate("wall_contacts"), 1.0 / n),
                             .dv_y =
                                 scaled(series.ratio("wall_impulse_y", "wall_contacts"), -n / mass),
                             .n_dot_dv_y = scaled(along.both, -1.0 / mass),
                             .gravity = state.gravity.y};
  // The ratio's own error is too wide where the momentum is bounded.
  const double of_quotient =
      std::hypot(b.n_dot_dv_y.error, b.dv_y.value * b.n_dot.error) / b.n_dot.value;
  b.dv_y.error = std::min(b.dv_y.error, of_quotient);
  return b;
}

io::FlowSummary::BrakingForce braking_force(const WallForces& along, const State& state) {
  io::FlowSummary::BrakingForce force{.left = scaled(along.left, -1.0),
                                      .right = {},
                                      .weight = total_mass(state.grains) * state.gravity.y};
  if (along.right) force.right = scaled(*along.right, -1.0);
  return force;
}

io::FlowSummary::WallPressure wall_pressure(const WallForces& across, const State& state) {
  const double per_length = 1.0 / state.box.length;
  io::FlowSummary::WallPressure p{.left = scaled(across.left, per_length), .right = {}};
  if (across.right) p.right = scaled(*across.right, -per_length);
  return p;
}

io::FlowSummary::WallVisits wall_visits(const CumulativeSeries& series, const VisitTally& tally) {
  const auto per_visit = [&](const char* name) { return series.ratio(name, "wall_visits"); };
  return {.visits = series.total("wall_visits"),
          .contacts = per_visit("wall_visit_contacts"),
          .dv_y = per_visit("wall_visit_dv_y"),
          .dv_x = per_visit("wall_visit_dv_x"),
          .entry_rate = per_visit("wall_visit_entry_rate"),
          .entry_slip = per_visit("wall_visit_entry_slip"),
          .of_contacts = tally.of_contacts};
}

io::FlowSummary::Energy energy_of(const State& state, const Energies& e) {
  return {.initial = state.origin.energy,
          .kinetic = e.kinetic,
          .rotational = e.rotational,
          .elastic = e.elastic,
          .gravity_work = e.gravity_work,
          .wall_work = e.wall_work,
          .normal_loss = e.normal_loss,
          .friction_loss = e.friction_loss,
          .residual = e.residual};
}

/// A flow that still gains speed only passes through its mean, so that an error bar would mean
/// nothing. Likewise for the temperature, if the flow is judged by it.
void take_error_bars_off(io::FlowSummary& s) {
  s.mean_axial_velocity.error = unknown;
  s.mass_flow_rate.error = unknown;
  if (s.judged_by == io::JudgedBy::granular_temperature)
    s.fluctuations.granular_temperature.error = unknown;
}

/// m/s, with which grains meet walls. A single grain has no fluctuations: that is its own velocity.
double speed_across(const io::RunFile& file, const io::FlowSummary::Fluctuations& fluctuations,
                    std::size_t grains, std::size_t first) {
  if (grains > 1) return fluctuations.sigma_vx.value;
  const std::vector<double> mean_vx = file.series("mean_vx");
  double squares = 0.0;
  for (const double v : std::span(mean_vx).subspan(first)) squares += v * v;
  return std::sqrt(squares / static_cast<double>(mean_vx.size() - first));
}

constexpr double enough_contacts = 20.0;  // fewer say nothing about a flow

/// Contacts with walls are judged after the transient, all else since the start.
Evidence evidence(const CumulativeSeries& series, const State& state, const Energies& energies,
                  const TypicalContacts& typical, double grain_contact_rate, std::size_t warnings) {
  const bool enough = series.total("wall_contacts_ended") >= enough_contacts;
  // Then no braking failed, even if there is none, as at smooth walls without friction.
  const bool none_failed = enough && series.total("wall_contacts_cut_short") == 0.0;
  const auto of_walls = [&](const char* part, const char* whole) {
    return enough ? series.quotient(part, whole) : unknown;
  };
  return {
      .max_overlap_ratio = largest_overlap(state).ratio,
      .brake_failure_fraction =
          none_failed ? 0.0 : of_walls("wall_braking_cut_short", "wall_braking"),
      .passages_per_visit = of_walls("wall_contacts_cut_short", "wall_visits"),
      .wall_speed_ratio = of_walls("wall_entry_slip", "wall_contacts_ended") / typical.v_crit,
      .pulling_fraction = of_walls("wall_pulling_time", "wall_contact_time"),
      .steps_per_contact = steps_per_contact(state),
      .energy_error_ratio = energy_error_ratio(state, energies),
      .limits_exceeded = static_cast<double>(warnings),
      .contact_rate_times_t_col = grain_contact_rate * typical.t_col_grains,
  };
}

io::FlowSummary::Validity validity_of(const CumulativeSeries& series, const State& state,
                                      const Energies& energies, const TypicalContacts& typical,
                                      double grain_contact_rate,
                                      const std::vector<std::string>& warnings) {
  return {.verdict = judge(
              evidence(series, state, energies, typical, grain_contact_rate, warnings.size())),
          .v_crit = typical.v_crit,
          .t_col_grains = typical.t_col_grains,
          .t_col_walls = typical.t_col_walls,
          .friction_failure_fraction =
              series.quotient("wall_friction_loss_cut_short", "wall_friction_loss"),
          .warnings = warnings};
}

}  // namespace

double steps_per_contact(const State& state) {
  double fewest = std::numeric_limits<double>::infinity();
  for (const ContactTally* kind : {&state.tally.grains, &state.tally.walls})
    if (static_cast<double>(kind->durations.total()) >= enough_contacts)
      fewest = std::min(fewest, kind->durations.quantile(0.05) / state.time_step);
  return std::isfinite(fewest) ? fewest : unknown;
}

io::FlowSummary summarise(const FlowRecords& records, const State& state, const ContactModel& model,
                          const Observables& last) {
  const auto& [file, steady, strips, profiles, interval, warnings] = records;
  const std::size_t first = steady.transient_end;
  const CumulativeSeries series(file, first, interval);

  io::FlowSummary s;
  s.time = state.time();
  s.transient_end = file.series("time")[first];
  s.state = steady.verdict;
  const Judged judged = judged_by(state, interval);
  s.judged_by = judged.series;
  if (steady.held_back_by) s.held_back_by = judged.others[*steady.held_back_by];
  s.mean_axial_velocity = mean_of(file, "mean_vy", first);
  s.independent_samples = steady.independent_samples;
  s.fluctuations = fluctuations_of(file, first);
  s.granular_temperature = s.fluctuations.granular_temperature.value;
  s.structure_factor = structure_factors_of(file, first);
  std::tie(s.core, s.wall_layers) =
      zones(profiles, strips, state.walls.size(), static_cast<std::int64_t>(first));
  const std::vector<double> v_y = velocities_by_mass(file, state, first, Axis::along);
  const std::vector<double> v_x = velocities_by_mass(file, state, first, Axis::across);
  const WallForces along = wall_forces(series, state, Axis::along, v_y, interval);
  const WallForces across = wall_forces(series, state, Axis::across, v_x, interval);
  s.mass_flow_rate = scaled(mean_with_error(v_y), total_mass(state.grains) / state.box.length);
  s.balance = balance(series, state, along);
  // Each contact counts for both of its grains.
  s.grain_contact_rate =
      scaled(series.rate("grain_contacts"), 2.0 / static_cast<double>(state.grains.size()));
  s.braking_force = braking_force(along, state);
  s.wall_pressure = wall_pressure(across, state);
  s.wall_visits = wall_visits(series, state.tally.visits);
  s.energy = energy_of(state, last.energies);
  const double speed = speed_across(file, s.fluctuations, state.grains.size(), first);
  s.validity = validity_of(series, state, last.energies, typical_contacts(state, model, speed),
                           s.grain_contact_rate.value, warnings);
  if (steady.verdict == SteadyVerdict::accelerating) take_error_bars_off(s);
  return s;
}

}  // namespace riesel::app
