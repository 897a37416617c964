#include "app/series.hpp"

namespace riesel::app {

namespace {

struct Entry {
  io::Column column;
  double (*value)(const Observables&);
};

const std::vector<Entry>& entries() {
  static const std::vector<Entry> table = {
      {{"time", "s", "Time since the start."}, [](auto& o) { return o.time; }},
      {{"mean_vx", "m/s", "Mean velocity across the tube."}, [](auto& o) { return o.mean_vx; }},
      {{"mean_vy", "m/s", "Mean axial velocity, positive downstream."},
       [](auto& o) { return o.mean_vy; }},
      {{"sigma_vx", "m/s", "Standard deviation of the grains' velocities across the tube."},
       [](auto& o) { return o.sigma_vx; }},
      {{"sigma_vy", "m/s", "Standard deviation of the grains' axial velocities."},
       [](auto& o) { return o.sigma_vy; }},
      {{"granular_temperature", "m^2/s^2", "Mean of the two squared standard deviations."},
       [](auto& o) { return o.granular_temperature; }},
      {{"kinetic_energy", "J", "Kinetic energy of all grains."},
       [](auto& o) { return o.energies.kinetic; }},
      {{"elastic_energy", "J", "Energy stored in contacts."},
       [](auto& o) { return o.energies.elastic; }},
      {{"gravity_work", "J", "Work of gravity since the start."},
       [](auto& o) { return o.energies.gravity_work; }},
      {{"normal_loss", "J", "Dissipated by normal damping since the start."},
       [](auto& o) { return o.energies.normal_loss; }},
      {{"friction_loss", "J", "Dissipated by friction since the start."},
       [](auto& o) { return o.energies.friction_loss; }},
      {{"energy_residual", "J", "What is missing in the balance of energy."},
       [](auto& o) { return o.energies.residual; }},
      {{"contacts", "1", "Lasting contacts per grain."}, [](auto& o) { return o.contacts; }},
      {{"grain_contacts", "1", "Contacts between grains begun since the start."},
       [](auto& o) { return o.grain_contacts_begun; }},
      {{"wall_contacts", "1", "Contacts with walls begun since the start."},
       [](auto& o) { return o.wall_contacts_begun; }},
      {{"wall_impulse_y", "kg m/s", "Axial impulse given to the grains by the walls so far."},
       [](auto& o) { return o.wall_impulse_y; }},
      {{"max_overlap", "m", "Largest overlap of all contacts so far."},
       [](auto& o) { return o.max_overlap; }},
  };
  return table;
}

}  // namespace

std::vector<io::Column> series_columns() {
  std::vector<io::Column> columns;
  for (const Entry& entry : entries()) columns.push_back(entry.column);
  return columns;
}

std::vector<double> series_row(const Observables& observables) {
  std::vector<double> row;
  for (const Entry& entry : entries()) row.push_back(entry.value(observables));
  return row;
}

}  // namespace riesel::app
