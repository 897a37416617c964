#include "scenarios/flow_start.hpp"

#include "engine/random.hpp"
#include "scenarios/contact_settings.hpp"
#include "scenarios/continued_start.hpp"
#include "scenarios/flow_refusals.hpp"
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

/// Ids have 31 bits; pairs of neighbours, a few per grain, are counted with 32 bits.
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

/// The velocity along y (m/s) at x (m), interpolated between those of the walls.
double velocity_between(const std::vector<WallLattice>& walls, double x) {
  const WallLattice &first = walls.front(), &last = walls.back();
  if (first.motion.velocity == last.motion.velocity) return first.motion.velocity;
  const double part = (x - first.line) / (last.line - first.line);
  return first.motion.velocity + part * (last.motion.velocity - first.motion.velocity);
}

/// Draws velocities and scales them, so that the velocity of the centre of mass and the mean square
/// of the random part are exactly as set. Adds the velocity between the walls, whose mean over the
/// grains is near zero, as they are spread at random.
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
  // A single grain is the centre of mass, so that only rounding is left of its random velocity.
  const double scale =
      grains.size() > 1 && rms > 0.0 ? settings.number("start.random_velocity") / rms : 0.0;
  for (Grain& grain : grains) {
    grain.vx *= scale;
    grain.vy = scale * grain.vy + settings.number("start.axial_velocity")
               + velocity_between(empty.walls, grain.x);
  }
}

/// The time step follows from the lightest pair. Damping matters most for the heaviest grain at the
/// wall, so that this contact is checked first, and rejected if it does not rebound. Also rejects
/// walls, output and gravity that do not suit this time step. `masses`: kg.
void set_time_step(const io::Settings& settings, const ContactModel& model,
                   std::span<const double> masses, State& state) {
  const auto [lightest, heaviest] = std::minmax_element(masses.begin(), masses.end());
  collision_time(settings, model, *heaviest);
  const double shortest = collision_time(settings, model, 0.5 * *lightest);
  state.time_step = time_step(settings, model, shortest, 0.5 * *lightest);
  reject_too_many_steps(settings, run_length(settings), state.time_step);
  reject_fast_walls(settings, state);
  reject_rows_in_step(settings, state);
  reject_unfit_gravity(settings, masses.size(), state);
}

/// Every flow is made here. `masses`: kg, of its grains. Once the time step is known,
/// `motion(state)` returns the grains with their initial velocities, which are checked before
/// `fill(state)` puts them into the state.
template <class Motion, class Fill>
Flow set_out(const io::Settings& settings, const ContactModel& model,
             std::span<const double> masses, State state, Motion motion, Fill fill) {
  set_time_step(settings, model, masses, state);
  reject_fast_motion(settings, motion(state), state);
  fill(state);
  reject_heavy_grains(settings, state);
  return {.state = std::move(state), .model = model};
}

Flow start_with(const std::vector<Grain>& grains, const io::Settings& settings,
                const ContactModel& model, State empty) {
  std::vector<double> masses;
  for (const Grain& grain : grains) masses.push_back(grain.mass);
  const auto motion = [&](const State&) -> const auto& { return grains; };
  const auto fill = [&](State& state) {
    for (const Grain& grain : grains) add_grain(state, grain);
  };
  return set_out(settings, model, masses, std::move(empty), motion, fill);
}

Flow start_from_file(const io::Settings& settings, const ContactModel& model, Room room) {
  const std::vector<Grain> grains = grains_of_file(settings, room);
  return start_with(grains, settings, model, std::move(room.empty));
}

Flow continue_run(const io::Settings& settings, const ContactModel& model, Room room) {
  const io::Checkpoint run = earlier_run(settings, room.empty);
  const State& earlier = run.state;
  room.reject_too_small(settings, {2.0 * std::ranges::max(earlier.grains.radius), "start.from"},
                        room.empty);
  const auto motion = [&](const State& state) {
    return half_a_step_before(earlier, state.time_step);
  };
  const auto fill = [&](State& state) { take_over(earlier, model, state); };
  Flow flow = set_out(settings, model, earlier.grains.mass, std::move(room.empty), motion, fill);
  flow.continues = to_be_continued(run);
  return flow;
}

/// To be called before memory is taken for each grain. `area`: m^2, of all grains.
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
       .doc = "Velocity of the grains' centre of mass along the walls at the start. Between walls "
              "that slide, the linear profile between their velocities is added.",
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
    settings.reject(fraction_key, "more than a start can place clear of the wall grains",
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
  room.reject_too_small(settings, {sizes.largest(), sizes.key()}, room.empty);
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
  std::vector<Grain> grains(radii.size());
  for (std::size_t i = 0; i < grains.size(); ++i)
    grains[i] = {.x = (*places)[i].x,
                 .y = (*places)[i].y,
                 .vx = 0.0,
                 .vy = 0.0,
                 .radius = radii[i],
                 .mass = mass_of_diameter(settings, 2.0 * radii[i])};
  return grains;
}

}  // namespace riesel::scenarios
