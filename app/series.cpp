#include "app/series.hpp"

#include "engine/brake.hpp"

#include <fmt/format.h>

namespace riesel::app {

namespace {

struct Entry {
  io::Column column;
  double (*value)(const Observables&, const Tally&);
};

double number(std::int64_t count) { return static_cast<double>(count); }

/// Sums over contacts that have ended and visits to walls that are over, all since the start.
const std::vector<Entry>& entries_of_contacts() {
  static const std::vector<Entry> table = {
      {{"grain_contacts_ended", "1", "Contacts between grains ended so far."},
       [](auto&, auto& t) { return number(t.grains.ended); }},
      {{"grain_contact_time", "s",
        "Sum of the durations of contacts between grains that have ended."},
       [](auto&, auto& t) { return t.grains.duration.value(); }},
      {{"grain_slip_path", "m",
        "Sum of the slip paths of contacts between grains that have ended."},
       [](auto&, auto& t) { return t.grains.slip_path.value(); }},
      {{"wall_contacts_ended", "1", "Contacts with walls ended so far."},
       [](auto&, auto& t) { return number(t.brakes.contacts); }},
      {{"wall_contacts_cut_short", "1",
        fmt::format("Contacts with walls that ended within {:.3g} t_col, as the grain had passed.",
                    cut_short_below)},
       [](auto&, auto& t) { return number(t.brakes.cut_short); }},
      {{"wall_braking", "kg m/s", "Axial impulse taken by wall contacts that brake."},
       [](auto&, auto& t) { return t.brakes.braking.value(); }},
      {{"wall_braking_cut_short", "kg m/s",
        "Axial impulse taken by wall contacts that brake and are cut short."},
       [](auto&, auto& t) { return t.brakes.braking_cut_short.value(); }},
      {{"wall_friction_loss", "J",
        "Dissipated by friction and resistance to rolling in wall contacts."},
       [](auto&, auto& t) { return t.brakes.friction_loss.value(); }},
      {{"wall_friction_loss_cut_short", "J",
        "Dissipated by friction and resistance to rolling in wall contacts that are cut short."},
       [](auto&, auto& t) { return t.brakes.friction_loss_cut_short.value(); }},
      {{"wall_entry_slip", "m/s",
        "Sum of the slip speeds of the centres at the beginning of wall contacts that have ended."},
       [](auto&, auto& t) { return t.brakes.entry_slip.value(); }},
      {{"wall_contact_time", "s", "Sum of the durations of wall contacts that have ended."},
       [](auto&, auto& t) { return t.brakes.duration.value(); }},
      {{"wall_slip_path", "m", "Sum of the slip paths of wall contacts that have ended."},
       [](auto&, auto& t) { return t.walls.slip_path.value(); }},
      {{"wall_pulling_time", "s", "The part of wall_contact_time in which the normal force pulls."},
       [](auto&, auto& t) { return t.brakes.pulling.value(); }},
      {{"wall_visits", "1", "Visits to walls that are over."},
       [](auto&, auto& t) { return number(t.visits.visits()); }},
      {{"wall_visit_contacts", "1", "Contacts of the visits to walls that are over."},
       [](auto&, auto& t) { return number(t.visits.contacts); }},
      {{"wall_visit_dv_y", "m/s", "Sum of the axial velocities lost in visits."},
       [](auto&, auto& t) { return t.visits.dv_y.value(); }},
      {{"wall_visit_dv_x", "m/s", "Sum of the velocities gained in visits away from the wall."},
       [](auto&, auto& t) { return t.visits.dv_x.value(); }},
      {{"wall_visit_entry_rate", "m/s", "Sum of the normal velocities at the beginning of visits."},
       [](auto&, auto& t) { return t.visits.entry_rate.value(); }},
      {{"wall_visit_entry_slip", "m/s",
        "Sum of the slip speeds of the centres at the beginning of visits."},
       [](auto&, auto& t) { return t.visits.entry_slip.value(); }},
  };
  return table;
}

const std::vector<Entry>& entries() {
  static const std::vector<Entry> table = {
      {{"time", "s", "Time since the start."}, [](auto& o, auto&) { return o.time; }},
      {{"mean_vx", "m/s", "Mean velocity across the tube."},
       [](auto& o, auto&) { return o.mean_vx; }},
      {{"mean_vy", "m/s", "Mean axial velocity, positive downstream."},
       [](auto& o, auto&) { return o.mean_vy; }},
      {{"sigma_vx", "m/s", "Standard deviation of the grains' velocities across the tube."},
       [](auto& o, auto&) { return o.sigma_vx; }},
      {{"sigma_vy", "m/s", "Standard deviation of the grains' axial velocities."},
       [](auto& o, auto&) { return o.sigma_vy; }},
      {{"granular_temperature", "m^2/s^2", "Mean of the squares of sigma_vx and sigma_vy."},
       [](auto& o, auto&) { return o.granular_temperature; }},
      {{"kinetic_energy", "J", "Kinetic energy of all grains, without rotation."},
       [](auto& o, auto&) { return o.energies.kinetic; }},
      {{"rotational_energy", "J", "Kinetic energy of rotation; 0 where grains do not rotate."},
       [](auto& o, auto&) { return o.energies.rotational; }},
      {{"mean_spin", "rad/s", "Mean spin of the grains, positive from x towards y."},
       [](auto& o, auto&) { return o.mean_spin; }},
      {{"rotational_temperature", "m^2/s^2", "Mean of I w^2 / m over the grains, w the spin."},
       [](auto& o, auto&) { return o.rotational_temperature; }},
      {{"elastic_energy", "J", "Energy stored in contacts."},
       [](auto& o, auto&) { return o.energies.elastic; }},
      {{"gravity_work", "J", "Work of gravity since the start."},
       [](auto& o, auto&) { return o.energies.gravity_work; }},
      {{"wall_work", "J", "Work of moving walls since the start."},
       [](auto& o, auto&) { return o.energies.wall_work; }},
      {{"normal_loss", "J", "Dissipated by normal damping since the start."},
       [](auto& o, auto&) { return o.energies.normal_loss; }},
      {{"friction_loss", "J", "Dissipated by friction and resistance to rolling since the start."},
       [](auto& o, auto&) { return o.energies.friction_loss; }},
      {{"energy_residual", "J", "Energy missing from the energy balance."},
       [](auto& o, auto&) { return o.energies.residual; }},
      {{"contacts", "1", "Current contacts per grain, with grains and walls, each counted once."},
       [](auto& o, auto&) { return o.contacts; }},
      {{"grain_contacts", "1", "Contacts between grains begun since the start."},
       [](auto& o, auto&) { return o.grain_contacts_begun; }},
      {{"wall_contacts", "1", "Contacts with walls begun since the start."},
       [](auto& o, auto&) { return o.wall_contacts_begun; }},
      {{"wall_impulse_y", "kg m/s", "Axial impulse given to the grains by the walls so far."},
       [](auto& o, auto&) { return o.wall_impulse_y; }},
      {{"left_wall_impulse_y", "kg m/s",
        "Axial impulse given to the grains by the left wall so far."},
       [](auto& o, auto&) { return o.impulse_y_of_wall[0]; }},
      {{"right_wall_impulse_y", "kg m/s",
        "Axial impulse given to the grains by the right wall so far."},
       [](auto& o, auto&) { return o.impulse_y_of_wall[1]; }},
      {{"left_wall_impulse_x", "kg m/s",
        "Impulse across the tube given to the grains by the left wall so far."},
       [](auto& o, auto&) { return o.impulse_x_of_wall[0]; }},
      {{"right_wall_impulse_x", "kg m/s",
        "Impulse across the tube given to the grains by the right wall so far."},
       [](auto& o, auto&) { return o.impulse_x_of_wall[1]; }},
      {{"max_overlap", "m", "Largest overlap of all contacts so far."},
       [](auto& o, auto&) { return o.max_overlap; }},
      {{"structure_factor_1", "1", "|rho_k|^2/N of the density wave as long as the tube."},
       [](auto& o, auto&) { return o.structure_factor[0]; }},
      {{"structure_factor_2", "1",
        "|rho_k|^2/N of the density wave with two periods along the tube."},
       [](auto& o, auto&) { return o.structure_factor[1]; }},
      {{"structure_factor_3", "1",
        "|rho_k|^2/N of the density wave with three periods along the tube."},
       [](auto& o, auto&) { return o.structure_factor[2]; }},
      {{"structure_factor_4", "1",
        "|rho_k|^2/N of the density wave with four periods along the tube."},
       [](auto& o, auto&) { return o.structure_factor[3]; }},
  };
  return table;
}

}  // namespace

std::vector<io::Column> series_columns() {
  std::vector<io::Column> columns;
  for (const auto* table : {&entries(), &entries_of_contacts()})
    for (const Entry& entry : *table) columns.push_back(entry.column);
  return columns;
}

std::vector<double> series_row(const Observables& observables, const Tally& tally) {
  std::vector<double> row;
  for (const auto* table : {&entries(), &entries_of_contacts()})
    for (const Entry& entry : *table) row.push_back(entry.value(observables, tally));
  return row;
}

}  // namespace riesel::app
