#include "app/flow_summary.hpp"

#include "engine/closed_forms.hpp"
#include "engine/steady_state.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace riesel::app {

namespace {

double total_mass(const Grains& grains) {
  ExactSum sum;  // the slots have no fixed order
  for (const double mass : grains.mass) sum.add(mass);
  return sum.value();
}

/// m/s, above which a grain that meets the wall with the typical random velocity passes a wall
/// grain sooner than the contact can push it away: chord over t_col.
double critical_velocity(const State& state, const ContactModel& model, double sigma_vx) {
  const double mass = total_mass(state.grains) / static_cast<double>(state.grains.size());
  const double speed = std::max(sigma_vx, 1e-6);  // m/s; a grain at rest sinks in nowhere
  const double t_col = collision_time(model.normal, mass, speed);
  const double reach = 0.5 * mean_diameter(state.grains) + state.walls.front().radius;
  return chord_of_impact(reach, speed, t_col) / t_col;
}

double mean_from(const std::vector<double>& series, std::size_t first) {
  const auto begin = series.begin() + static_cast<std::ptrdiff_t>(first);
  return std::accumulate(begin, series.end(), 0.0) / static_cast<double>(series.end() - begin);
}

/// Eq. (9), from what has happened between row `first` and the last row.
io::FlowSummary::Balance balance(const io::RunFile& file, std::size_t first, double interval,
                                 const State& state) {
  const std::vector<double> contacts = file.series("wall_contacts");
  const std::vector<double> impulse = file.series("wall_impulse_y");
  io::FlowSummary::Balance b;
  b.gravity = state.gravity;
  const double duration = interval * static_cast<double>(contacts.size() - 1 - first);
  const double count = contacts.back() - contacts[first];
  if (duration <= 0.0 || count <= 0.0) return b;
  const auto n = static_cast<double>(state.grains.size());
  b.n_dot = count / (n * duration);
  b.dv_y = -(impulse.back() - impulse[first]) / (total_mass(state.grains) / n) / count;
  b.n_dot_dv_y = b.n_dot * b.dv_y;
  return b;
}

}  // namespace

io::FlowSummary summarise(const io::RunFile& file, const State& state, const ContactModel& model,
                          const Observables& last, double interval) {
  const std::vector<double> velocity = file.series("mean_vy");
  const SteadyState steady = assess_steady_state(velocity, state.gravity * interval);

  io::FlowSummary s;
  s.time = state.time();
  s.state = std::string(name(steady.verdict));
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  s.mean_axial_velocity = {.value = steady.mean,
                           .error = velocity.size() > 1 ? steady.error : unknown};
  s.independent_samples = steady.independent_samples;
  if (steady.transient_end < velocity.size()) {
    s.transient_end = file.series("time")[steady.transient_end];
    s.granular_temperature = mean_from(file.series("granular_temperature"), steady.transient_end);
    s.balance = balance(file, steady.transient_end, interval, state);
    s.validity.v_crit =
        critical_velocity(state, model, mean_from(file.series("sigma_vx"), steady.transient_end));
  }
  s.validity.max_overlap_ratio = last.max_overlap / mean_diameter(state.grains);
  const Energies& e = last.energies;
  s.energy = {.initial = state.origin.kinetic,
              .kinetic = e.kinetic,
              .elastic = e.elastic,
              .gravity_work = e.gravity_work,
              .normal_loss = e.normal_loss,
              .friction_loss = e.friction_loss,
              .residual = e.residual};
  return s;
}

}  // namespace riesel::app
