// Grains between two walls that move past each other, without gravity: a periodic shear cell, to be
// compared with the kinetic theory of Jenkins and Richman, Phys. Fluids 28, 3485 (1985).
//
// The walls put energy in, collisions take it out. If the restitution is close to 1 and the walls
// are far apart, the shear rate in the middle is uniform, and the temperature there is the one at
// which both balance.
#include "scenarios/flow_start.hpp"
#include "scenarios/walls.hpp"

namespace riesel::scenarios {

namespace {

io::SettingsTable cell_settings() {
  return {
      {.key = "cell.width",
       .unit = "m",
       .fallback = "20 mm",
       .range = io::positive(),
       .doc = "Distance between the two wall lines."},
      {.key = "cell.length",
       .unit = "m",
       .fallback = "40 mm",
       .range = io::positive(),
       .doc = "Period of the cell."},
      {.key = "cell.velocity",
       .unit = "m/s",
       .fallback = "1 m/s",
       .range = io::non_negative(),
       .doc =
           "Velocity of the walls past each other: the right one moves along +y with half of it, "
           "the left one along -y."},
  };
}

State empty_cell(const io::Settings& settings) {
  State state;
  state.box = {.width = settings.number("cell.width"), .length = settings.number("cell.length")};
  for (const double side : {-1.0, 1.0}) {
    const double line = side < 0.0 ? 0.0 : state.box.width;
    WallLattice wall = wall_at(line, settings, state.box, "cell.length");
    wall.motion.velocity = 0.5 * side * settings.number("cell.velocity");
    state.walls.push_back(wall);
  }
  return state;
}

void reject_small_cell(const io::Settings& settings, const LargestGrain& largest,
                       const State& empty) {
  reject_small_space(settings, largest, empty, "cell");
}

Problem prepare(const io::Settings& settings) {
  return start_flow(settings, {.empty = empty_cell(settings),
                               .reject_too_small = reject_small_cell,
                               .place_grains = fill_between_walls});
}

}  // namespace

Scenario shear_cell() {
  return {.name = "shear_cell",
          .summary = "Grains between two walls that move past each other: temperature and stresses "
                     "under shear (Jenkins and Richman 1985).",
          .own_settings = flow_table({size_settings(), area_fraction_settings(), wall_settings(),
                                      cell_settings(), start_velocity_settings("0")}),
          .prepare = prepare};
}

}  // namespace riesel::scenarios
