#include "engine/typical_contacts.hpp"

#include "engine/closed_forms.hpp"
#include "engine/require.hpp"

#include <algorithm>
#include <limits>

namespace riesel {

TypicalContacts typical_contacts(const State& state, const ContactModel& model, double across) {
  require(!state.walls.empty(), "contacts with walls need a wall");
  const double mass = mean_mass(state.grains);
  const double speed = std::max(across, slowest_across);
  const WallLattice& wall = state.walls.front();
  const double reach = 0.5 * mean_diameter(state.grains) + wall.radius;
  const double t_col_walls = collision_time(model.normal, mass, speed, model.attraction);
  // A smooth wall has no edge that a grain could pass.
  const double chord = wall.smooth() ? std::numeric_limits<double>::infinity()
                                     : chord_of_impact(reach, speed, t_col_walls);
  return {.t_col_grains = collision_time(model.normal, 0.5 * mass, speed, model.attraction),
          .t_col_walls = t_col_walls,
          .chord = chord,
          .v_crit = critical_velocity(chord, t_col_walls)};
}

}  // namespace riesel
