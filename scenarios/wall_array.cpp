// One grain hits an endless row of wall grains: Figs. 4 and 5 of Schaefer and Wolf, Phys. Rev. E
// 51, 6154 (1995).
//
// Results are means over starting places spread over one wavelength of the wall. At high axial
// velocity a grain touches two or more wall grains before it leaves, and the loss of axial velocity
// rises again: the paper calls this the emergency brake.
#include "engine/closed_forms.hpp"
#include "scenarios/contact_settings.hpp"
#include "scenarios/impact_settings.hpp"
#include "scenarios/walls.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace riesel::scenarios {

namespace {

io::SettingsTable own_settings() {
  io::SettingsTable rows = impact_settings();
  const io::SettingsTable more = {
      {.key = "wall.spacing",
       .unit = "m",
       .fallback = "0.66 mm",
       .range = io::positive(),
       .doc = "Distance between the centres of neighbouring wall grains (the wavelength of the "
              "wall)."},
      {.key = "impact.height",
       .unit = "m",
       .example = "1 mm",
       .range = io::positive(),
       .doc = "Distance of the free grain's centre from the wall line at the start. By default the "
              "sum of the radii, where nothing can touch yet."},
      {.key = "impact.starts",
       .kind = io::Kind::integer,
       .fallback = "10",
       .range = io::between(1, 10000),
       .doc = "Number of starting places, evenly spread over one spacing of the wall grains."},
      {.key = "impact.normal_velocity",
       .kind = io::Kind::numbers,
       .unit = "m/s",
       .fallback = "[0.1 m/s, 0.3 m/s, 0.5 m/s]",
       .range = io::positive(),
       .doc = "Velocities towards the wall before the impact: one curve each."},
  };
  rows.insert(rows.end(), more.begin(), more.end());
  return rows;
}

double start_height(const io::Settings& settings, const ImpactSetup& setup) {
  const double reach = setup.reach();
  if (!settings.has("impact.height")) return reach;
  const double height = settings.number("impact.height");
  if (height < reach * (1.0 - 1e-12))
    settings.reject("impact.height", "the grain would overlap a wall grain at the start",
                    fmt::format("choose at least the sum of the two radii, {:.6g} m", reach));
  if (height > greatest_height(setup))
    settings.reject("impact.height", "too far from the wall",
                    fmt::format("choose at most {:.3g} m; is a unit forgotten, as in '1 mm'?",
                                greatest_height(setup)));
  return height;
}

/// A summary with more points could not be read back; an impact takes 50 bytes of memory.
void reject_too_many(const io::Settings& settings) {
  constexpr std::size_t most_points = 50'000, most_impacts = 10'000'000;
  constexpr auto normal = "impact.normal_velocity", axial = "impact.axial_velocity";
  const std::size_t lines = settings.numbers(normal).size();
  const std::size_t points = lines * settings.numbers(axial).size();
  const std::size_t impacts = points * static_cast<std::size_t>(settings.integer("impact.starts"));
  const std::string remedy = "choose fewer, or several runs (riesel sweep)";
  if (points > most_points)
    settings.reject(lines * lines > points ? normal : axial,
                    fmt::format("{} points, of all velocities towards and along the wall, are more "
                                "than {}",
                                points, most_points),
                    remedy);
  if (impacts > most_impacts)
    settings.reject(
        "impact.starts",
        fmt::format("{} impacts in {} points are more than {}", impacts, points, most_impacts),
        remedy);
}

Problem prepare(const io::Settings& settings) {
  const double spacing = settings.number("wall.spacing");
  ImpactCurve curve = empty_curve(settings, spacing);
  reject_crowded_wall(settings, curve.setup.reach(), spacing);
  const double height = start_height(settings, curve.setup);
  reject_too_many(settings);

  std::vector<double> starts(static_cast<std::size_t>(settings.integer("impact.starts")));
  for (std::size_t i = 0; i < starts.size(); ++i)
    starts[i] = static_cast<double>(i) * spacing / static_cast<double>(starts.size());

  const std::vector<double> towards = settings.numbers("impact.normal_velocity");
  reject_heavy_bodies(settings, "grains.mass", curve.setup.grain_mass, "impact.normal_velocity",
                      std::ranges::max(towards));
  for (const double v_x : towards) {
    const double chord = chord_of_impact(curve.setup.reach(), v_x, curve.setup.collision_time);
    for (const double v_y : settings.numbers("impact.axial_velocity"))
      add_point(settings, curve, v_x, v_y, height, starts, chord);
  }
  return curve;
}

}  // namespace

Scenario wall_array() {
  return {.name = "wall_array",
          .summary =
              "A grain hits an endless row of wall grains: loss of axial velocity and number of "
              "contacts (Figs. 4 and 5).",
          .own_settings = own_settings(),
          .prepare = prepare};
}

}  // namespace riesel::scenarios
