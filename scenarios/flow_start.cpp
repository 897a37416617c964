#include "scenarios/flow_start.hpp"

#include "engine/exact_sum.hpp"
#include "engine/observables.hpp"
#include "engine/random.hpp"
#include "scenarios/contact_settings.hpp"
#include "scenarios/continued_start.hpp"
#include "scenarios/grain_file.hpp"
#include "scenarios/packing.hpp"
#include "scenarios/run_length.hpp"
#include "scenarios/walls.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

namespace riesel::scenarios {

namespace {

using std::numbers::pi;

constexpr auto fraction_key = "grains.area_fraction";

/// Ids have 31 bits; pairs of neighbours, a few per grain, are counted by 32.
constexpr double most_grains = 1e9;

/// `start.kind` and `start.from`.
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
              "grains, the walls and the tube must be the same, but for gravity, angles and what "
              "moves the walls.",
       .only_when = io::When{"start.kind", {"continued"}},
       .names_content = true},
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

/// m/s, of walls that shear what is between them, at x (m).
double velocity_between(const std::vector<WallLattice>& walls, double x) {
  const WallLattice &first = walls.front(), &last = walls.back();
  if (first.motion.velocity == last.motion.velocity) return first.motion.velocity;
  const double part = (x - first.line) / (last.line - first.line);
  return first.motion.velocity + part * (last.motion.velocity - first.motion.velocity);
}

/// Velocities as set, exactly: that of the centre of mass, and the mean square of the random part;
/// and besides those of the walls.
void set_velocities(const io::Settings& settings, const State& empty, std::vector<Grain>& grains) {
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
  // A single grain is the centre of mass: what is left of its velocity is rounding.
  const double scale =
      grains.size() > 1 && rms > 0.0 ? settings.number("start.random_velocity") / rms : 0.0;
  for (Grain& grain : grains) {
    grain.vx *= scale;
    grain.vy = scale * grain.vy + settings.number("start.axial_velocity")
               + velocity_between(empty.walls, grain.x);
  }
}

/// What falls freely from one look to the next must not get so fast that it seems slow again.
void reject_strong_gravity(const io::Settings& settings, std::size_t grains, const State& state) {
  const double largest = largest_speed(state.box, state.time_step, grains)
                         / (static_cast<double>(steps_per_look) * state.time_step);
  if (std::hypot(state.gravity.x, state.gravity.y) < largest) return;
  settings.reject(
      "gravity",
      fmt::format("too strong for this tube and a time step of {:.3g} s", state.time_step),
      fmt::format("choose less than {:.3g} m/s^2, or a shorter time step: a light grain or a stiff "
                  "contact (do grains.mass and contact.stiffness have their units?)",
                  largest));
}

/// Velocities change by whole quanta in a step: where it is very short, or gravity very small, by a
/// gravity of other size than is set.
void reject_rounded_gravity(const io::Settings& settings, const State& state) {
  constexpr double tolerated = 1e-3;  // of gravity
  const Box& box = state.box;
  const FixedVector fall = fall_per_step(state);
  const double per_step2 = 1.0 / (state.time_step * state.time_step);
  const double error = std::hypot(box.metres_x(fall.x) * per_step2 - state.gravity.x,
                                  box.metres_y(fall.y) * per_step2 - state.gravity.y);
  const double gravity = std::hypot(state.gravity.x, state.gravity.y);
  if (error <= tolerated * gravity) return;
  constexpr auto steps_key = "run.steps_per_collision";
  settings.reject(settings.given(steps_key) ? steps_key : "gravity",
                  fmt::format("with a time step of {:.3g} s gravity would be off by {:.2g} %, as "
                              "what it adds in a step is rounded",
                              state.time_step, 100.0 * error / gravity),
                  "choose gravity 0 or a stronger one, fewer run.steps_per_collision, softer or "
                  "heavier grains, or a smaller system");
}

/// From the lightest pair. Damping counts most for the heaviest grain at the wall: rejects it if it
/// does not rebound, before any other is asked. Rejects walls and gravity that steps as long do not
/// follow.
void set_time_step(const io::Settings& settings, const ContactModel& model,
                   std::span<const double> masses, State& state) {
  const auto [lightest, heaviest] = std::minmax_element(masses.begin(), masses.end());
  collision_time(settings, model, *heaviest);
  const double shortest = collision_time(settings, model, 0.5 * *lightest);
  state.time_step = time_step(settings, model, shortest, 0.5 * *lightest);
  reject_too_many_steps(settings, run_length(settings), state.time_step);
  reject_fast_walls(settings, state);
  reject_rows_in_step(settings, state);
  reject_strong_gravity(settings, masses.size(), state);
  reject_rounded_gravity(settings, state);
}

void reject_fast_grains(const io::Settings& settings, const std::vector<Grain>& grains,
                        const State& state) {
  const double largest = largest_speed(state.box, state.time_step, grains.size());
  const bool held =
      std::ranges::all_of(grains, [&](const Grain& g) { return std::hypot(g.vx, g.vy) < largest; });
  if (held) return;
  const std::string problem = "too fast for this tube and time step";
  const std::string remedy = fmt::format("choose velocities below {:.3g} m/s", largest);
  const std::string kind = settings.text("start.kind");
  if (kind == "file") settings.reject("start.from", problem, remedy);
  if (kind == "continued")
    settings.reject("start.from", "has grains too fast for this tube and time step",
                    remedy + ", or stiffer contacts, whose time step is shorter");
  const bool by_chance = std::abs(settings.number("start.random_velocity"))
                         > std::abs(settings.number("start.axial_velocity"));
  settings.reject(by_chance ? "start.random_velocity" : "start.axial_velocity", problem, remedy);
}

/// What the grains have together must be less than sums hold.
void reject_heavy_grains(const io::Settings& settings, const State& state) {
  const double largest = largest_sum(state);
  if (largest < ExactSum::largest_sum) return;
  settings.reject(settings.text("start.kind") == "fresh" ? "grains.mass" : "start.from",
                  fmt::format("grains so heavy that their masses or energies, {:.3g} in SI units, "
                              "are beyond what sums hold",
                              largest),
                  fmt::format("choose lighter ones, for less than {:.3g} in all (do masses and "
                              "velocities have their units?); stiffness may be scaled with the "
                              "mass, which changes no motion",
                              ExactSum::largest_sum));
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

/// Of grains that are not in the state yet, as it may not hold them.
void reject_fast_motion(const io::Settings& settings, const std::vector<Grain>& grains,
                        const State& state) {
  reject_fast_grains(settings, grains, state);
  reject_fast_spins(settings, grains, state);
}

Flow start_with(const std::vector<Grain>& grains, const io::Settings& settings,
                const ContactModel& model, State state) {
  std::vector<double> masses;
  for (const Grain& grain : grains) masses.push_back(grain.mass);
  set_time_step(settings, model, masses, state);
  reject_fast_motion(settings, grains, state);
  for (const Grain& grain : grains) add_grain(state, grain);
  reject_heavy_grains(settings, state);
  return {.state = std::move(state), .model = model};
}

Flow start_from_file(const io::Settings& settings, const ContactModel& model, Room room) {
  const std::vector<Grain> grains = grains_of_file(settings, room.empty);
  const double largest = 2.0 * std::ranges::max(grains, {}, &Grain::radius).radius;
  room.reject_too_small(settings, largest, room.empty);
  return start_with(grains, settings, model, std::move(room.empty));
}

Flow continue_run(const io::Settings& settings, const ContactModel& model, Room room) {
  const State earlier = earlier_state(settings, room.empty);
  room.reject_too_small(settings, 2.0 * std::ranges::max(earlier.grains.radius), room.empty);
  reject_other_swing_across(settings, earlier, room.empty);
  set_time_step(settings, model, earlier.grains.mass, room.empty);
  reject_fast_motion(settings, half_a_step_before(earlier, room.empty.time_step), room.empty);
  take_over(earlier, model, room.empty);
  reject_heavy_grains(settings, room.empty);
  return {.state = std::move(room.empty), .model = model};
}

/// Before anything is made for each of them. `area`: m^2, of all grains.
void reject_too_many(const io::Settings& settings, const SizeDistribution& sizes, double area) {
  const double expected = area / (0.25 * pi * sizes.mean_square());
  if (expected > most_grains)
    settings.reject(sizes.key(),
                    fmt::format("about {:.3g} grains of {:.3g} m would be needed to cover {:.3g} "
                                "m^2, more than {:g}",
                                expected, std::sqrt(sizes.mean_square()), area, most_grains),
                    "choose larger grains, or less room for them; is a unit forgotten, as in "
                    "'1 mm'?");
}

}  // namespace

io::SettingsTable flow_table(std::initializer_list<io::SettingsTable> rows) {
  io::SettingsTable table = start_settings();
  for (const io::SettingsTable& some : rows) table.insert(table.end(), some.begin(), some.end());
  const io::SettingsTable common = common_flow_settings();
  table.insert(table.end(), common.begin(), common.end());
  return table;
}

io::SettingsTable start_velocity_settings(const std::string& axial, const std::string& random) {
  return {
      {.key = "start.axial_velocity",
       .unit = "m/s",
       .fallback = axial,
       .range = io::any(),
       .doc = "Velocity of the grains' centre of mass along the walls at the start.",
       .only_when = io::When{"start.kind", {"fresh"}}},
      {.key = "start.random_velocity",
       .unit = "m/s",
       .fallback = random,
       .range = io::non_negative(),
       .doc = "Root mean square of the random velocities at the start, per component; they are "
              "normally distributed and their momenta add up to zero.",
       .only_when = io::When{"start.kind", {"fresh"}}},
  };
}

io::SettingsTable area_fraction_settings() {
  return {
      {.key = fraction_key,
       .unit = "1",
       .fallback = "0.55",
       .range = io::between(0.001, 0.9),
       .doc = "Area of the free grains divided by that between the wall lines; approximated to "
              "within one grain.",
       .only_when = io::When{"start.kind", {"fresh", "continued"}}},
  };
}

std::vector<Grain> fill_between_walls(const io::Settings& settings, const SizeDistribution& sizes,
                                      const State& empty) {
  const double wanted = settings.number(fraction_key) * empty.box.width;
  const double free_width =
      empty.box.width - (empty.walls.front().radius + empty.walls.back().radius);
  const double densest = pi / std::sqrt(12.0);  // discs on a triangular lattice
  if (wanted > densest * free_width)
    settings.reject(fraction_key, "more than can be packed between the wall grains",
                    fmt::format("choose at most {:.3f}, and less for grains of unequal size",
                                std::floor(1e3 * densest * free_width / empty.box.width) / 1e3));
  const std::vector<double> radii = radii_of_area(settings, sizes, wanted * empty.box.length);
  std::vector<Grain> grains = packed_grains(settings, radii, empty);
  if (grains.empty())
    settings.reject(fraction_key, "no start without overlaps was found",
                    "choose a smaller fraction, or grains of more equal size");
  return grains;
}

Flow start_flow(const io::Settings& settings, Room room) {
  room.empty.grains.inertia = inertia(settings);
  const ContactModel model = contact_model(settings);
  const std::string& kind = settings.text("start.kind");
  if (kind == "file") return start_from_file(settings, model, std::move(room));
  if (kind == "continued") return continue_run(settings, model, std::move(room));
  const SizeDistribution sizes(settings);
  room.reject_too_small(settings, sizes.largest(), room.empty);
  std::vector<Grain> grains = room.place_grains(settings, sizes, room.empty);
  set_velocities(settings, room.empty, grains);
  return start_with(grains, settings, model, std::move(room.empty));
}

std::vector<double> radii_of_area(const io::Settings& settings, const SizeDistribution& sizes,
                                  double wanted) {
  reject_too_many(settings, sizes, wanted);
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

std::vector<Grain> packed_grains(const io::Settings& settings, const std::vector<double>& radii,
                                 const State& empty) {
  const auto places = pack(empty, radii, static_cast<std::uint64_t>(settings.integer("seed")));
  if (!places) return {};
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
  return grains;
}

}  // namespace riesel::scenarios
