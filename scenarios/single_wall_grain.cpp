// One grain grazes one wall grain: Figs. 2 and 3 of Schaefer and Wolf, Phys. Rev. E 51, 6154
// (1995).
//
// The free grain comes along y at a given height above the wall line, and friction takes some of
// its axial velocity. Above v_crit = chord / t_col it passes before the contact can push it away,
// and the loss falls again. The chord is its path on which the two overlap.
#include "engine/closed_forms.hpp"
#include "scenarios/impact_settings.hpp"

#include <fmt/core.h>

namespace riesel::scenarios {

namespace {

io::SettingsTable own_settings() {
  io::SettingsTable rows = impact_settings();
  rows.push_back(
      {.key = "impact.height",
       .unit = "m",
       .fallback = "0.82 mm",
       .range = io::non_negative(),
       .doc = "Distance of the free grain's centre from the wall line before the impact."});
  return rows;
}

Problem prepare(const io::Settings& settings) {
  ImpactCurve curve = empty_curve(settings, 0.0);
  const double reach = curve.setup.reach();
  const double height = settings.number("impact.height");
  if (height >= reach)
    settings.reject("impact.height", "the grain passes above the wall grain without touching it",
                    fmt::format("choose it below the sum of the two radii, {:.6g} m", reach));
  const std::vector<double> start = {just_upstream(curve.setup, height)};
  for (const double v_y : settings.numbers("impact.axial_velocity"))
    add_point(settings, curve, 0.0, v_y, height, start, chord(reach, height));
  return curve;
}

}  // namespace

Scenario single_wall_grain() {
  return {.name = "single_wall_grain",
          .summary = "A grain grazes a single wall grain: loss of axial velocity against velocity "
                     "(Fig. 3).",
          .own_settings = own_settings(),
          .prepare = prepare};
}

}  // namespace riesel::scenarios
