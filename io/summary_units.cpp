#include "io/summary_units.hpp"

#include <array>
#include <string_view>

namespace riesel::io {

namespace {

struct Unit {
  std::string_view name, unit;
};

/// For all names that begin like this.
constexpr std::array<Unit, 4> of_sections = {{{"braking_force.", "N"},
                                              {"wall_pressure.", "N/m"},
                                              {"energy.", "J"},
                                              {"validity.t_col.", "s"}}};

/// For all names whose last part is this.
constexpr auto of_values = std::to_array<Unit>({
    {"time", "s"},
    {"transient_end", "s"},
    {"wall_seconds", "s"},
    {"t_col", "s"},
    {"particle_steps_per_second", "1/s"},
    {"mass_flow_rate", "kg/s"},
    {"n_dot", "1/s"},
    {"grain_contact_rate", "1/s"},
    {"mean_axial_velocity", "m/s"},
    {"sigma_vx", "m/s"},
    {"sigma_vy", "m/s"},
    {"dv_x", "m/s"},
    {"dv_y", "m/s"},
    {"entry_rate", "m/s"},
    {"entry_slip", "m/s"},
    {"v_crit", "m/s"},
    {"v_x", "m/s"},
    {"largest_dv_y", "m/s"},
    {"largest_at", "m/s"},
    {"brake_fails_at", "m/s"},
    {"brake_fails_within", "m/s"},
    {"two_contacts_at", "m/s"},
    {"two_contacts_within", "m/s"},
    {"n_dot_dv_y", "m/s^2"},
    {"gravity", "m/s^2"},
    {"granular_temperature", "m^2/s^2"},
    {"temperature_x", "m^2/s^2"},
    {"temperature_y", "m^2/s^2"},
    {"stress_xx", "N/m"},
    {"stress_yy", "N/m"},
    {"stress_xy", "N/m"},
    {"shear_rate", "1/s"},
    {"mean_spin", "rad/s"},
    {"rotational_temperature", "m^2/s^2"},
});

}  // namespace

std::string unit_of_result(std::string_view name) {
  for (const Unit& section : of_sections)
    if (name.starts_with(section.name)) return std::string(section.unit);
  for (const std::string_view part : {".value", ".error"})
    if (name.ends_with(part)) name.remove_suffix(part.size());
  const std::string_view last = name.substr(name.rfind('.') + 1);  // all of it if there is no dot
  for (const Unit& value : of_values)
    if (last == value.name) return std::string(value.unit);
  return {};
}

}  // namespace riesel::io
