// The settings of every scenario: the seed, whether grains rotate, the contact law and how the run
// is stepped.
#include "io/settings_table.hpp"

namespace riesel::io {
namespace {

const When linear_law = {"contact.law", {"linear"}};
const When power_law = {"contact.law", {"power"}};
const When nonlinear_law = {"contact.law", {"power", "hertz"}};
const When viscous_slip = {"contact.slip", {"viscous"}};
const When spring_slip = {"contact.slip", {"spring"}};
const When rotating = {"grains.rotation", {"disc", "sphere"}};

/// F_N = k xi^alpha + gamma xi^beta (d xi/dt)^g, written with the reduced mass for the linear law
/// (see the manual's physics page).
SettingsTable normal_force_settings() {
  return {
      {.key = "contact.law",
       .kind = Kind::choice,
       .fallback = "linear",
       .choices = {"linear", "power", "hertz"},
       .doc = "Law of the normal force: `linear` spring and dashpot, a `power` law with free "
              "exponents, or `hertz` for Hertz-Kuwabara-Kono (exponents 3/2, 1/2 and 1)."},
      {.key = "contact.stiffness",
       .unit = "N/m",
       .starter = "2000 N/m",
       .required = true,
       .range = positive(),
       .doc = "Stiffness k_N of the linear law.",
       .only_when = linear_law},
      {.key = "contact.stiffness",
       .example = "5.9e5",
       .required = true,
       .range = positive(),
       .doc = "Elastic prefactor k of the law; its unit is N/m^alpha.",
       .only_when = nonlinear_law},
      {.key = "contact.damping",
       .unit = "1/s",
       .range = non_negative(),
       .doc = "Damping gamma_N of the linear law, per reduced mass. Give this or "
              "`contact.restitution`.",
       .only_when = linear_law},
      {.key = "contact.damping",
       .example = "4.1",
       .required = true,
       .range = non_negative(),
       .doc = "Dissipative prefactor gamma of the law; its unit is N s^g / m^(beta + g).",
       .only_when = nonlinear_law},
      {.key = "contact.restitution",
       .unit = "1",
       .starter = "0.9",
       .range = above_up_to(0.0, 1.0),
       .doc = "Coefficient of normal restitution, from which the damping follows. Give this or "
              "`contact.damping`.",
       .only_when = linear_law},
      {.key = "contact.restitution_of",
       .kind = Kind::choice,
       .fallback = "wall",
       .choices = {"wall", "grains", "all"},
       .doc = "The pair to which `contact.restitution` refers: a grain of `grains.mass` and the "
              "`wall`, or two such `grains`; other pairs have another one, as gamma_N is the same "
              "for all. Or `all` pairs, whatever their masses: then gamma_N is proportional to "
              "m_red^(-1/2). Without a meaning beside `contact.damping`, where `all` is refused.",
       .only_when = linear_law},
      {.key = "contact.exponent_elastic",
       .unit = "1",
       .fallback = "1.5",
       .range = positive(),
       .doc = "Exponent alpha of the overlap in the elastic force.",
       .only_when = power_law},
      {.key = "contact.exponent_overlap",
       .unit = "1",
       .fallback = "0.5",
       .range = non_negative(),
       .doc = "Exponent beta of the overlap in the dissipative force.",
       .only_when = power_law},
      {.key = "contact.exponent_rate",
       .unit = "1",
       .fallback = "1",
       .range = positive(),
       .doc = "Exponent g of the overlap's rate in the dissipative force.",
       .only_when = power_law},
      {.key = "contact.impact_speed",
       .unit = "m/s",
       .fallback = "1 m/s",
       .range = positive(),
       .doc =
           "Speed of fast impacts: the time step follows from the duration of a contact at this "
           "speed. Those of faster impacts are shorter; with `exponent_elastic` below 1 they are "
           "longer, and this must be the speed of slow impacts.",
       .only_when = nonlinear_law},
      {.key = "contact.attraction",
       .kind = Kind::choice,
       .fallback = "keep",
       .choices = {"keep", "clip"},
       .doc =
           "Near the end of a contact the dashpot would pull the bodies together: `keep` that "
           "attraction, or `clip` the normal force at zero. Either way the coefficient reached is "
           "`contact.restitution`, if that is given."},
  };
}

SettingsTable friction_settings() {
  return {
      {.key = "contact.friction",
       .unit = "1",
       .fallback = "0.5",
       .range = non_negative(),
       .doc = "Coefficient of Coulomb friction mu, between grains and at walls."},
      {.key = "contact.slip",
       .kind = Kind::choice,
       .fallback = "cap",
       .choices = {"cap", "literal", "viscous", "spring"},
       .doc = "How friction behaves near zero slip: `cap` limits it to the force that by "
              "itself stops the slip within one step, `literal` applies the full force with the "
              "sign of the slip, "
              "`viscous` limits it by a viscous force, `spring` by a tangential spring that "
              "remembers the distance slipped."},
      {.key = "contact.slip_damping",
       .unit = "1/s",
       .required = true,
       .range = positive(),
       .doc = "Coefficient gamma_t of the viscous limit, per reduced mass.",
       .only_when = viscous_slip},
      {.key = "contact.slip_stiffness",
       .unit = "N/m",
       .required = true,
       .range = positive(),
       .doc = "Stiffness k_t of the tangential spring.",
       .only_when = spring_slip},
      {.key = "contact.slip_damping",
       .unit = "1/s",
       .fallback = "0 1/s",
       .range = non_negative(),
       .doc = "Damping gamma_t of the tangential spring, per reduced mass.",
       .only_when = spring_slip},
  };
}

SettingsTable run_settings() {
  return {
      {.key = "run.steps_per_collision",
       .unit = "1",
       .fallback = "50",
       .range = at_least(5.0),
       .doc =
           "The time step is this part of the shortest of: t_col of all pairs that can meet; half "
           "a period of the tangential spring, if there is one; in impacts the passage of a wall "
           "grain; twice the t_col without damping (which counts below e_N = 0.0043 only)."},
      {.key = "run.threads",
       .kind = Kind::integer_or_auto,
       .fallback = "auto",
       .range = between(1, most_threads),
       .doc = "Threads to use; `auto` uses as many as are worthwhile for the number of "
              "grains. The results do not depend on it.",
       .matters = false},
      {.key = "run.stepping",
       .kind = Kind::choice,
       .fallback = "auto",
       .choices = {"auto", "plain", "windows"},
       .doc = "Whether all grains are moved in each step (`plain`), or those in free flight cross "
              "many steps at once (`windows`). The results do not depend on it.",
       .matters = false},
  };
}

SettingsTable rotation_settings() {
  return {
      {.key = "grains.rotation",
       .kind = Kind::choice,
       .fallback = "none",
       .choices = {"none", "disc", "sphere"},
       .doc =
           "Whether free grains rotate: `none` (as in the paper), or with the moment of inertia of "
           "a `disc` (m r^2/2) or a `sphere` (2/5 m r^2). Wall grains do not rotate."},
      {.key = "contact.rolling_friction",
       .unit = "1",
       .fallback = "0",
       .range = non_negative(),
       .doc = "Coefficient mu_r of the resistance to rolling, relative to r_i r_j/(r_i + r_j).",
       .only_when = rotating},
  };
}

void append(SettingsTable& table, const SettingsTable& rows) {
  table.insert(table.end(), rows.begin(), rows.end());
}

}  // namespace

SettingsTable common_settings() {
  SettingsTable table = {
      {.key = "scenario",
       .kind = Kind::text,
       .required = true,
       .doc = "The scenario to run; `riesel scenarios` lists them."},
      {.key = "seed",
       .kind = Kind::integer,
       .fallback = "1",
       .range = non_negative(),
       .doc = "Seed of the random numbers: the same seed gives the same run, bit by bit."},
  };
  append(table, normal_force_settings());
  append(table, friction_settings());
  append(table, run_settings());
  append(table, rotation_settings());
  return table;
}

}  // namespace riesel::io
