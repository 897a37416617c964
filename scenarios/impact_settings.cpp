#include "scenarios/impact_settings.hpp"

#include "scenarios/contact_settings.hpp"

#include <algorithm>

namespace riesel::scenarios {

io::SettingsTable impact_settings() {
  return {
      {.key = "grains.diameter",
       .unit = "m",
       .fallback = "1 mm",
       .range = io::positive(),
       .doc = "Diameter of the free grain."},
      {.key = "grains.mass",
       .unit = "kg",
       .fallback = "1 mg",
       .range = io::positive(),
       .doc = "Mass of the free grain."},
      {.key = "wall.grain_diameter",
       .unit = "m",
       .fallback = "0.66 mm",
       .range = io::positive(),
       .doc = "Diameter of the wall grains, which are fixed."},
      {.key = "impact.axial_velocity",
       .kind = io::Kind::numbers,
       .unit = "m/s",
       .fallback = "{from: 0.1 m/s, to: 40 m/s, points: 60, spacing: log}",
       .range = io::positive(),
       .doc = "Velocities along the wall before the impact: one point of the curve each."},
  };
}

ImpactCurve empty_curve(const io::Settings& settings, double wall_spacing) {
  ImpactCurve curve;
  ImpactSetup& setup = curve.setup;
  setup.grain_radius = 0.5 * settings.number("grains.diameter");
  setup.grain_mass = settings.number("grains.mass");
  setup.wall_grain_radius = 0.5 * settings.number("wall.grain_diameter");
  setup.wall_spacing = wall_spacing;
  reject_heavy_bodies(settings, "grains.mass", setup.grain_mass, "impact.axial_velocity",
                      std::ranges::max(settings.numbers("impact.axial_velocity")));
  setup.model = contact_model(settings);
  setup.inertia = inertia(settings);
  setup.collision_time = collision_time(settings, setup.model, setup.grain_mass);
  return curve;
}

void add_point(const io::Settings& settings, ImpactCurve& curve, double v_x, double v_y, double x,
               const std::vector<double>& starts, double chord) {
  const ImpactSetup& setup = curve.setup;
  const double dt = time_step(settings, setup.model, std::min(setup.collision_time, chord / v_y),
                              setup.grain_mass);
  curve.points.push_back(
      {.v_x = v_x, .v_y = v_y, .first_impact = curve.impacts.size(), .impacts = starts.size()});
  for (const double y : starts)
    curve.impacts.push_back({.x = x, .y = y, .v_x = v_x, .v_y = v_y, .time_step = dt});
}

}  // namespace riesel::scenarios
