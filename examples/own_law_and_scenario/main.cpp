// A contact law and a scenario of one's own: a program that has them beside all that riesel has.
#include "app/command.hpp"
#include "engine/random.hpp"
#include "scenarios/contact_settings.hpp"
#include "scenarios/packing.hpp"
#include "scenarios/scenario.hpp"

#include <cmath>
#include <numbers>

using namespace riesel;

/// A spring that stiffens: F_N = k xi (1 + xi/delta) + gamma m_red d(xi)/dt.
struct StiffeningLaw {
  double k;      // N/m
  double gamma;  // 1/s
  double delta;  // m

  double elastic(double xi) const { return k * xi * (1.0 + xi / delta); }
  double damping(double, double rate, double m_red) const { return gamma * m_red * rate; }
  double stored_energy(double xi) const { return k * xi * xi * (0.5 + xi / (3.0 * delta)); }
  ElasticLine elastic_line() const { return {k, 1.0}; }  // of small overlaps
};

io::Setting row(const char* key, const char* unit, const char* fallback, const char* doc) {
  return {.key = key, .unit = unit, .fallback = fallback, .range = io::positive(), .doc = doc};
}

scenarios::Law stiffening() {
  return {.name = "stiffening",
          .own_settings = {row("contact.stiffness", "N/m", "2000 N/m", "Of small overlaps."),
                           row("contact.damping", "1/s", "1e4 1/s", "Per reduced mass."),
                           row("contact.stiffening_overlap", "m", "0.1 mm", "Twice as stiff.")},
          .make = [](const io::Settings& settings) -> NormalLaw {
            return OuterLaw(StiffeningLaw{.k = settings.number("contact.stiffness"),
                                          .gamma = settings.number("contact.damping"),
                                          .delta = settings.number("contact.stiffening_overlap")});
          }};
}

io::SettingsTable cooling_settings() {
  io::SettingsTable rows = scenarios::common_flow_settings();
  rows.push_back(row("grains.diameter", "m", "1 mm", "Of grains and wall grains."));
  rows.push_back(row("grains.mass", "kg", "1 mg", "Of a grain."));
  rows.push_back(row("grains.area_fraction", "1", "0.2", "Area of the grains over size^2."));
  rows.push_back(row("grains.random_velocity", "m/s", "1 m/s", "At the start, per component."));
  rows.push_back(row("tube.size", "m", "30 mm", "Width and length."));
  return rows;
}

/// Grains fly about between two rough walls, without gravity, and lose their energy.
scenarios::Problem cooling(const io::Settings& settings) {
  const double size = settings.number("tube.size");
  const double radius = 0.5 * settings.number("grains.diameter");
  const double mass = settings.number("grains.mass");
  const auto count = std::llround(0.5 * size / radius);
  State state;
  state.box = {.width = size, .length = size};
  state.walls = {{.line = 0.0, .radius = radius, .count = count},
                 {.line = size, .radius = radius, .count = count}};
  const ContactModel model = scenarios::contact_model(settings);
  const double t_col = scenarios::collision_time(settings, model, 0.5 * mass);
  state.time_step = scenarios::time_step(settings, model, t_col, 0.5 * mass);
  state.grains.inertia = scenarios::inertia(settings);  // grains.rotation

  const auto seed = static_cast<std::uint64_t>(settings.integer("seed"));
  const double area = settings.number("grains.area_fraction") * size * size;
  const std::vector<double> radii(std::llround(area / (std::numbers::pi * radius * radius)),
                                  radius);
  const auto places = scenarios::pack(state, radii, seed);
  if (!places) settings.reject("grains.area_fraction", "no room", "choose less");
  const RandomStream velocities(seed, Use::velocity);
  const double speed = settings.number("grains.random_velocity");
  for (std::size_t i = 0; i < radii.size(); ++i) {
    const auto [vx, vy] = velocities.normal(i);
    const auto [x, y] = (*places)[i];
    add_grain(state, {x, y, speed * vx, speed * vy, radius, mass});
  }
  return scenarios::Flow{.state = state, .model = model};
}

int main(int argc, char** argv) {
  scenarios::add(stiffening());
  scenarios::add({.name = "cooling",
                  .summary = "Grains between rough walls lose their energy.",
                  .own_settings = cooling_settings(),
                  .prepare = cooling});
  return app::command(argc, argv);
}
