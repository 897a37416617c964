// A column of beads is dropped on a plate: Luding, Clement, Blumen, Rajchenbach and Duran, Phys.
// Rev. E 50, 4113 (1994).
//
// A test of whether t_col is short enough. Hard beads collide one pair after the other. Soft ones
// that are close together at the start touch several others at once, and lose less energy.
#include "engine/closed_forms.hpp"
#include "scenarios/contact_settings.hpp"
#include "scenarios/scenario.hpp"

namespace riesel::scenarios {

namespace {

io::SettingsTable own_settings() {
  return {
      {.key = "grains.diameter",
       .unit = "m",
       .fallback = "1 mm",
       .range = io::positive(),
       .doc = "Diameter of the beads."},
      {.key = "grains.mass",
       .unit = "kg",
       .fallback = "1 mg",
       .range = io::positive(),
       .doc = "Mass of a bead."},
      {.key = "column.beads",
       .kind = io::Kind::integer,
       .fallback = "10",
       .range = io::between(1, 100),
       .doc = "Number of beads, one above the other."},
      {.key = "column.velocity",
       .unit = "m/s",
       .fallback = "1 m/s",
       .range = io::positive(),
       .doc = "Velocity of all beads towards the plate before the impact."},
      {.key = "column.gap_ratio",
       .kind = io::Kind::numbers,
       .unit = "1",
       .fallback = "{from: 0.01, to: 10, points: 31, spacing: log}",
       .range = io::above_up_to(0.0, 1e3),
       .doc = "Gap between neighbouring beads before the impact, over the way that a bead goes "
              "during t_col of its contact with the plate: one point of the curve each."},
  };
}

/// The limit of hard beads needs restitutions that do not depend on the speed: rejects other laws.
void require_closed_form(const io::Settings& settings) {
  if (settings.text("contact.law") != "linear")
    settings.reject("contact.law", "its restitution depends on the speed",
                    "choose linear: hard beads to compare with need one restitution");
}

Problem prepare(const io::Settings& settings) {
  require_closed_form(settings);
  ColumnCurve curve{};
  ColumnSetup& setup = curve.setup;
  setup.beads = static_cast<int>(settings.integer("column.beads"));
  setup.bead_radius = 0.5 * settings.number("grains.diameter");
  setup.bead_mass = settings.number("grains.mass");
  setup.velocity = settings.number("column.velocity");
  reject_heavy_bodies(settings, "grains.mass", setup.beads * setup.bead_mass, "column.velocity",
                      setup.velocity);
  setup.model = contact_model(settings);
  setup.collision_time = collision_time(settings, setup.model, setup.bead_mass);
  setup.time_step =
      time_step(settings, setup.model, collision_time(settings, setup.model, 0.5 * setup.bead_mass),
                0.5 * setup.bead_mass);
  const auto restitution = [&](double reduced_mass) {
    return linear_contact(setup.model.normal, reduced_mass, setup.model.attraction)
        .value()
        .restitution();
  };
  curve.rigid =
      rigid_column(setup.beads, restitution(0.5 * setup.bead_mass), restitution(setup.bead_mass));
  curve.gap_ratios = settings.numbers("column.gap_ratio");
  return curve;
}

}  // namespace

Scenario bead_column() {
  return {.name = "bead_column",
          .summary =
              "A column of beads is dropped on a plate: energy kept against the gaps between "
              "them (Luding et al. 1994).",
          .own_settings = own_settings(),
          .prepare = prepare};
}

}  // namespace riesel::scenarios
