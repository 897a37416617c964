#include "scenarios/walls.hpp"

#include "engine/observables.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace riesel::scenarios {

namespace {

using std::numbers::pi;

constexpr auto amplitude_key = "wall.shake_amplitude", frequency_key = "wall.shake_frequency",
               angle_key = "wall.shake_angle";

WallMotion shaking(const io::Settings& settings, const Box& box, const std::string& key_of_length) {
  const double amplitude = settings.number(amplitude_key), angle = settings.number(angle_key);
  if (amplitude > 0.25 * std::min(box.width, box.length))
    settings.reject(amplitude_key, "more than a quarter of the period or of the width",
                    "choose it smaller, or the room larger (" + key_of_length + ")");
  return {.amplitude_x = amplitude * std::sin(angle),
          .amplitude_y = amplitude * std::cos(angle),
          .frequency = settings.number(frequency_key)};
}

/// The walls and the grains do not fit: the key that was given of the two, or that of the walls.
std::string to_blame(const io::Settings& settings, const std::string& key_of_walls) {
  constexpr auto diameter = "grains.diameter";
  return settings.given(diameter) && !settings.given(key_of_walls) ? diameter : key_of_walls;
}

}  // namespace

io::SettingsTable wall_settings() {
  const io::When corrugated = {"wall.surface", {"corrugated"}};
  return {
      {.key = "wall.surface",
       .kind = io::Kind::choice,
       .fallback = "corrugated",
       .choices = {"corrugated", "smooth"},
       .doc = "A row of fixed grains, or a plane at the wall line."},
      {.key = "wall.grain_diameter",
       .unit = "m",
       .fallback = "0.66 mm",
       .range = io::positive(),
       .doc = "Diameter of the wall grains, which are fixed.",
       .only_when = corrugated},
      {.key = "wall.spacing",
       .unit = "m",
       .fallback = "1.2 mm",
       .range = io::positive(),
       .doc = "Distance between the centres of neighbouring wall grains; adjusted so that a whole "
              "number of them fits the length.",
       .only_when = corrugated},
      {.key = amplitude_key,
       .unit = "m",
       .fallback = "0",
       .range = io::non_negative(),
       .doc = "The walls shake, all alike: by this much to either side."},
      {.key = frequency_key,
       .unit = "1/s",
       .fallback = "0",
       .range = io::non_negative(),
       .doc = "How often, as a sine of the time."},
      {.key = angle_key,
       .unit = "rad",
       .fallback = "0",
       .range = io::between(-0.5 * pi, 0.5 * pi),
       .doc = "In which direction: 0 along the walls, 90 degrees across them."},
  };
}

WallLattice wall_at(double line, const io::Settings& settings, const Box& box,
                    const std::string& key_of_length) {
  const WallMotion motion = shaking(settings, box, key_of_length);
  if (settings.text("wall.surface") == "smooth")
    return {.line = line, .radius = 0.0, .count = 0, .motion = motion};
  const double spacing = settings.number("wall.spacing");
  if (spacing > box.length)
    settings.reject("wall.spacing", "wider than the walls are long",
                    "choose it below " + key_of_length);
  return {.line = line,
          .radius = 0.5 * settings.number("wall.grain_diameter"),
          .count = std::llround(box.length / spacing),
          .motion = motion};
}

void reject_short_period(const io::Settings& settings, double largest, const State& empty,
                         const std::string& key_of_length) {
  const double length = empty.box.length;
  if (length < 4.0 * largest * (1.0 - 1e-12))
    settings.reject(to_blame(settings, key_of_length),
                    fmt::format("the periodic {} is too short for grains of this size",
                                io::section_of(key_of_length)),
                    fmt::format("choose smaller grains, or for {} at least four diameters, "
                                "{:.6g} m",
                                key_of_length, 4.0 * largest));
  if (const double most = 0.5 * length - largest; 2.0 * empty.walls.front().radius > most)
    settings.reject(
        "wall.grain_diameter",
        fmt::format("too large for a periodic {} of this length", io::section_of(key_of_length)),
        fmt::format("choose at most {:.6g} m; is a unit forgotten, as in '0.66 mm'?", most));
}

void reject_narrow_gap(const io::Settings& settings, double largest, const State& empty,
                       const std::string& key_of_width) {
  const double needed = largest + 2.0 * empty.walls.front().radius;
  if (empty.box.width < needed)
    settings.reject(
        to_blame(settings, key_of_width),
        fmt::format("the {} is too narrow for the grains between the wall grains",
                    io::section_of(key_of_width)),
        fmt::format("choose smaller grains, or {} above {:.6g} m", key_of_width, needed));
}

void reject_fast_walls(const io::Settings& settings, const State& state) {
  for (const WallLattice& wall : state.walls) {
    const double shaken = wall.motion.fastest_oscillation(),
                 steady = std::abs(wall.motion.velocity);
    const double largest = largest_speed(state.box, state.time_step, 1);
    if (steady + shaken < largest) continue;
    settings.reject(shaken > steady ? frequency_key : "cell.velocity",
                    "moves a wall too fast for this time step",
                    fmt::format("choose a velocity of the wall below {:.3g} m/s", largest));
  }
}

}  // namespace riesel::scenarios
