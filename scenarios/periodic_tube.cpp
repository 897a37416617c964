// Many grains fall through a vertical tube with corrugated walls, periodic along the fall: Fig. 6
// of Schaefer and Wolf, Phys. Rev. E 51, 6154 (1995).
//
// Started slowly, the grains reach a steady state in which collisions with the walls balance
// gravity. Started fast, they may reach another one, which the paper shows to be an artefact of
// soft grains. The tube may be tilted, up to horizontal.
#include "scenarios/flow_start.hpp"
#include "scenarios/walls.hpp"

#include <numbers>

namespace riesel::scenarios {

namespace {

using std::numbers::pi;

io::SettingsTable tube_settings() {
  return {
      {.key = "tube.width",
       .unit = "m",
       .fallback = "20 mm",
       .range = io::positive(),
       .doc =
           "Distance between the two wall lines, on which the centres of the wall grains stand."},
      {.key = "tube.length",
       .unit = "m",
       .fallback = "100 mm",
       .range = io::positive(),
       .doc = "Period of the tube."},
      {.key = "tube.tilt",
       .unit = "rad",
       .fallback = "0",
       .range = io::between(0.0, 0.5 * pi),
       .doc = "Angle between the axis of the tube and the vertical: 0 stands upright, 90 degrees "
              "lies; it leans towards the left wall."},
      {.key = "gravity",
       .unit = "m/s^2",
       .fallback = "10 m/s^2",
       .range = io::non_negative(),
       .doc = "Acceleration of free fall: along the tube where that stands upright."},
  };
}

State empty_tube(const io::Settings& settings) {
  State state;
  state.box = {.width = settings.number("tube.width"), .length = settings.number("tube.length")};
  for (const double line : {0.0, state.box.width})
    state.walls.push_back(wall_at(line, settings, state.box, "tube.length"));
  const double gravity = settings.number("gravity");
  const auto [along, across] = direction(settings.number("tube.tilt"));
  state.gravity = {.x = -gravity * across, .y = gravity * along};
  return state;
}

void reject_small_tube(const io::Settings& settings, const LargestGrain& largest,
                       const State& empty) {
  reject_small_space(settings, largest, empty, "tube");
}

Problem prepare(const io::Settings& settings) {
  return start_flow(settings, {.empty = empty_tube(settings),
                               .reject_too_small = reject_small_tube,
                               .place_grains = fill_between_walls});
}

}  // namespace

Scenario periodic_tube() {
  return {.name = "periodic_tube",
          .summary =
              "Grains fall through a periodic vertical tube with corrugated walls: steady mean "
              "velocity (Fig. 6).",
          .own_settings = flow_table({size_settings(), area_fraction_settings(), wall_settings(),
                                      tube_settings(), start_velocity_settings("1 m/s")}),
          .prepare = prepare};
}

}  // namespace riesel::scenarios
