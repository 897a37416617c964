// Many grains fall through a vertical tube with corrugated walls, periodic along the fall: Fig. 6
// of Schaefer and Wolf, Phys. Rev. E 51, 6154 (1995).
//
// Started slowly, the grains reach a steady state in which collisions with the walls balance
// gravity. Started fast, they may reach another one, which the paper shows to be an artefact of
// soft grains.
#include "engine/closed_forms.hpp"
#include "engine/observables.hpp"
#include "engine/random.hpp"
#include "scenarios/contact_settings.hpp"
#include "scenarios/continued_start.hpp"
#include "scenarios/grain_file.hpp"
#include "scenarios/packing.hpp"
#include "scenarios/run_length.hpp"
#include "scenarios/scenario.hpp"
#include "scenarios/size_distribution.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

namespace riesel::scenarios {

namespace {

using std::numbers::pi;

/// First of all: what stands below depends on it.
io::SettingsTable start_settings() {
  return {
      {.key = "start.kind",
       .kind = io::Kind::choice,
       .fallback = "fresh",
       .choices = {"fresh", "continued", "file"},
       .doc = "Grains at random places (`fresh`), those of another run where it ended "
              "(`continued`), or those in a `file`."},
      {.key = "start.from",
       .kind = io::Kind::path,
       .required = true,
       .doc = "The run to be continued: its directory or its checkpoint.h5. The settings of the "
              "grains, the walls and the tube must be the same.",
       .only_when = io::When{"start.kind", {"continued"}}},
      {.key = "start.from",
       .kind = io::Kind::path,
       .required = true,
       .doc = "File of the grains, CSV with the columns `x (mm)`, `y (mm)`, `vx (m/s)`, `vy "
              "(m/s)`, `diameter (mm)` and, if not in proportion to the area, `mass (mg)`, or "
              "with other units (docs/files.md).",
       .only_when = io::When{"start.kind", {"file"}},
       .names_content = true},
  };
}

io::SettingsTable flow_settings() {
  return {
      {.key = "grains.area_fraction",
       .unit = "1",
       .fallback = "0.55",
       .range = io::between(0.001, 0.9),
       .doc =
           "Area of the free grains divided by width times length of the tube; met to one grain.",
       .only_when = io::When{"start.kind", {"fresh", "continued"}}},
      {.key = "wall.grain_diameter",
       .unit = "m",
       .fallback = "0.66 mm",
       .range = io::positive(),
       .doc = "Diameter of the wall grains, which are fixed."},
      {.key = "wall.spacing",
       .unit = "m",
       .fallback = "1.2 mm",
       .range = io::positive(),
       .doc = "Distance between the centres of neighbouring wall grains; adjusted so that a whole "
              "number of them fits the length."},
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
      {.key = "gravity",
       .unit = "m/s^2",
       .fallback = "10 m/s^2",
       .range = io::non_negative(),
       .doc = "Acceleration along the tube."},
      {.key = "start.axial_velocity",
       .unit = "m/s",
       .fallback = "1 m/s",
       .range = io::any(),
       .doc = "Velocity of the grains' centre of mass at the start.",
       .only_when = io::When{"start.kind", {"fresh"}}},
      {.key = "start.random_velocity",
       .unit = "m/s",
       .fallback = "0.5 m/s",
       .range = io::non_negative(),
       .doc = "Root mean square of the random velocities at the start, per component; they are "
              "normally distributed and their momenta add up to zero.",
       .only_when = io::When{"start.kind", {"fresh"}}},
  };
}

io::SettingsTable own_settings() {
  io::SettingsTable table = start_settings();
  for (const auto& rows : {size_settings(), flow_settings(), common_flow_settings()})
    table.insert(table.end(), rows.begin(), rows.end());
  return table;
}

State empty_tube(const io::Settings& settings) {
  State state;
  state.box = {.width = settings.number("tube.width"), .length = settings.number("tube.length")};
  const double radius = 0.5 * settings.number("wall.grain_diameter");
  const double spacing = settings.number("wall.spacing");
  if (spacing > state.box.length)
    settings.reject("wall.spacing", "wider than the tube is long",
                    "choose it below tube.length or make the tube longer");
  const std::int64_t count = std::llround(state.box.length / spacing);
  state.walls = {{.line = 0.0, .radius = radius, .count = count},
                 {.line = state.box.width, .radius = radius, .count = count}};
  state.gravity = settings.number("gravity");
  state.grains.inertia = inertia(settings);
  return state;
}

/// As many grains as bring their area closest to the fraction.
std::vector<double> draw_radii(const io::Settings& settings, const SizeDistribution& sizes,
                               const Box& box) {
  const double wanted = settings.number("grains.area_fraction") * box.width * box.length;
  std::vector<double> radii;
  for (double area = 0.0;;) {
    const double radius = 0.5 * sizes.diameter(radii.size());
    const double next = area + pi * radius * radius;
    const bool closer_without = next - wanted > wanted - area;
    if (closer_without && !radii.empty()) return radii;
    radii.push_back(radius);
    area = next;
  }
}

/// The tube and the grains do not fit: the key that was given of the two, or that of the tube.
std::string to_blame(const io::Settings& settings, const char* key_of_tube) {
  constexpr auto diameter = "grains.diameter";
  return settings.given(diameter) && !settings.given(key_of_tube) ? diameter : key_of_tube;
}

/// `largest`: diameter of a grain, m.
void reject_small_tube(const io::Settings& settings, double largest, const State& empty) {
  const auto [width, length] = empty.box;
  if (length < 4.0 * largest * (1.0 - 1e-12))
    settings.reject(
        to_blame(settings, "tube.length"), "the periodic tube is too short for grains of this size",
        fmt::format("choose smaller grains, or for tube.length at least four diameters, "
                    "{:.6g} m",
                    4.0 * largest));
  const double wall_diameter = 2.0 * empty.walls.front().radius;
  if (const double most = 0.5 * length - largest; wall_diameter > most)
    settings.reject(
        "wall.grain_diameter", "too large for a periodic tube of this length",
        fmt::format("choose at most {:.6g} m; is a unit forgotten, as in '0.66 mm'?", most));
  const double needed = largest + wall_diameter;
  if (width < needed)
    settings.reject(to_blame(settings, "tube.width"),
                    "the tube is too narrow for the grains between the wall grains",
                    fmt::format("choose smaller grains, or tube.width above {:.6g} m", needed));
}

void reject_overfilled_tube(const io::Settings& settings, const State& empty) {
  const double free_width = empty.box.width - 2.0 * empty.walls.front().radius;
  const double densest = pi / std::sqrt(12.0);  // discs on a triangular lattice
  const double wanted = settings.number("grains.area_fraction");
  if (wanted * empty.box.width > densest * free_width)
    settings.reject("grains.area_fraction", "more than can be packed between the wall grains",
                    fmt::format("choose at most {:.3f}, and less for grains of unequal size",
                                std::floor(1e3 * densest * free_width / empty.box.width) / 1e3));
}

/// Velocities as set, exactly: that of the centre of mass, and the mean square of the random part.
void set_velocities(const io::Settings& settings, std::vector<Grain>& grains) {
  const RandomStream stream(static_cast<std::uint64_t>(settings.integer("seed")), Use::velocity);
  double mass = 0.0, px = 0.0, py = 0.0;
  for (std::size_t i = 0; i < grains.size(); ++i) {
    const auto [vx, vy] = stream.normal(i);
    grains[i].vx = vx;
    grains[i].vy = vy;
    mass += grains[i].mass;
    px += grains[i].mass * vx;
    py += grains[i].mass * vy;
  }
  double squares = 0.0;
  for (Grain& grain : grains) {
    grain.vx -= px / mass;
    grain.vy -= py / mass;
    squares += grain.vx * grain.vx + grain.vy * grain.vy;
  }
  const double rms = std::sqrt(squares / (2.0 * static_cast<double>(grains.size())));
  const double scale = rms > 0.0 ? settings.number("start.random_velocity") / rms : 0.0;
  for (Grain& grain : grains) {
    grain.vx *= scale;
    grain.vy = scale * grain.vy + settings.number("start.axial_velocity");
  }
}

std::vector<Grain> start_grains(const io::Settings& settings, const SizeDistribution& sizes,
                                const State& empty) {
  const std::vector<double> radii = draw_radii(settings, sizes, empty.box);
  const auto places = pack(empty, radii, static_cast<std::uint64_t>(settings.integer("seed")));
  if (!places)
    settings.reject("grains.area_fraction", "no start without overlaps was found",
                    "choose a smaller fraction, or grains of more equal size");
  const double mean_radius = 0.5 * settings.number("grains.diameter");
  std::vector<Grain> grains(radii.size());
  for (std::size_t i = 0; i < grains.size(); ++i) {
    const double relative = radii[i] / mean_radius;
    grains[i] = {.x = (*places)[i].x,
                 .y = (*places)[i].y,
                 .vx = 0.0,
                 .vy = 0.0,
                 .radius = radii[i],
                 .mass = settings.number("grains.mass") * relative * relative};
  }
  set_velocities(settings, grains);
  return grains;
}

/// From the lightest pair. Damping counts most for the heaviest grain at the wall: rejects it if it
/// does not rebound.
void set_time_step(const io::Settings& settings, const ContactModel& model,
                   std::span<const double> masses, State& state) {
  const auto [lightest, heaviest] = std::minmax_element(masses.begin(), masses.end());
  const double shortest = collision_time(settings, model, 0.5 * *lightest);
  collision_time(settings, model, *heaviest);
  state.time_step = time_step(settings, model, shortest, 0.5 * *lightest);
  const RunLength length = run_length(settings);
  if (length.at_most / state.time_step > most_steps)
    settings.reject(length.key, "more time steps than can be counted",
                    fmt::format("choose at most {:.3g} s", most_steps * state.time_step));
}

void reject_fast_grains(const io::Settings& settings, const std::vector<Grain>& grains,
                        const State& state) {
  const double largest = largest_speed(state.box, state.time_step, grains.size());
  const bool held =
      std::ranges::all_of(grains, [&](const Grain& g) { return std::hypot(g.vx, g.vy) < largest; });
  if (held) return;
  const bool of_file = settings.text("start.kind") == "file";
  const auto speed_by = [&](const char* key) {
    return of_file ? 0.0 : std::abs(settings.number(key));
  };
  const bool by_chance = speed_by("start.random_velocity") > speed_by("start.axial_velocity");
  settings.reject(of_file     ? "start.from"
                  : by_chance ? "start.random_velocity"
                              : "start.axial_velocity",
                  "too fast for this tube and time step",
                  fmt::format("choose velocities below {:.3g} m/s", largest));
}

/// An eighth of a turn in a step; a few times more, and it would seem slow again.
void reject_fast_spins(const io::Settings& settings, const std::vector<Grain>& grains,
                       const State& state) {
  const double largest = 0.25 * pi / state.time_step;
  const bool held =
      std::ranges::all_of(grains, [&](const Grain& g) { return std::abs(g.spin) < largest; });
  if (!held)
    settings.reject("start.from", "has spins too fast for this time step",
                    fmt::format("choose spins below {:.3g} 1/s", largest));
}

Problem start_with(const std::vector<Grain>& grains, const io::Settings& settings,
                   const ContactModel& model, State state) {
  std::vector<double> masses;
  for (const Grain& grain : grains) masses.push_back(grain.mass);
  set_time_step(settings, model, masses, state);
  reject_fast_grains(settings, grains, state);
  reject_fast_spins(settings, grains, state);
  for (const Grain& grain : grains) add_grain(state, grain);
  return Flow{.state = std::move(state), .model = model};
}

Problem start_from_file(const io::Settings& settings, const ContactModel& model, State state) {
  const std::vector<Grain> grains = grains_of_file(settings, state);
  const double largest = 2.0 * std::ranges::max(grains, {}, &Grain::radius).radius;
  reject_small_tube(settings, largest, state);
  return start_with(grains, settings, model, std::move(state));
}

Problem continue_run(const io::Settings& settings, const ContactModel& model, State state) {
  const State earlier = earlier_state(settings);
  reject_small_tube(settings, 2.0 * std::ranges::max(earlier.grains.radius), state);
  set_time_step(settings, model, earlier.grains.mass, state);
  take_over(earlier, model, state);
  return Flow{.state = std::move(state), .model = model};
}

Problem prepare(const io::Settings& settings) {
  State state = empty_tube(settings);
  const ContactModel model = contact_model(settings);
  const std::string& kind = settings.text("start.kind");
  if (kind == "file") return start_from_file(settings, model, std::move(state));
  if (kind == "continued") return continue_run(settings, model, std::move(state));
  const SizeDistribution sizes(settings);
  reject_small_tube(settings, sizes.largest(), state);
  reject_overfilled_tube(settings, state);
  const std::vector<Grain> grains = start_grains(settings, sizes, state);
  return start_with(grains, settings, model, std::move(state));
}

}  // namespace

Scenario periodic_tube() {
  return {.name = "periodic_tube",
          .summary =
              "Grains fall through a periodic vertical tube with corrugated walls: steady mean "
              "velocity (Fig. 6).",
          .own_settings = own_settings(),
          .prepare = prepare};
}

}  // namespace riesel::scenarios
