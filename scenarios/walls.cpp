#include "scenarios/walls.hpp"

#include "engine/observables.hpp"
#include "engine/stopping_rule.hpp"
#include "io/units.hpp"
#include "scenarios/run_length.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace riesel::scenarios {

namespace {

using std::numbers::pi;

constexpr auto amplitude_key = "wall.shake_amplitude", frequency_key = "wall.shake_frequency",
               angle_key = "wall.shake_angle";

/// If only one of two is given, the other has probably been forgotten; unless the one is 0.
void reject_half_given(const io::Settings& settings, const char* given, const char* missing) {
  if (settings.given(given) && settings.number(given) != 0.0 && !settings.given(missing))
    settings.reject(given, std::string("has no effect without ") + missing,
                    std::string("give ") + missing + ", too, or remove both");
}

/// `part` (m) is the amplitude in one direction, `room` (m) the size of the box in it.
void reject_large_swing(const io::Settings& settings, double part, double room, const char* name) {
  if (std::abs(part) <= 0.25 * room) return;
  settings.reject(
      amplitude_key,
      fmt::format("swings by {:.4g} m along a {} of {:.4g} m, more than a quarter of it",
                  std::abs(part), name, room),
      "choose it smaller; is a unit forgotten, as in '0.5 mm'?");
}

WallMotion shaking(const io::Settings& settings, const Box& box) {
  reject_half_given(settings, amplitude_key, frequency_key);
  reject_half_given(settings, frequency_key, amplitude_key);
  reject_half_given(settings, angle_key, amplitude_key);
  const double amplitude = settings.number(amplitude_key);
  const auto [along, across] = direction(settings.number(angle_key));
  const WallMotion motion{.amplitude_x = amplitude * across,
                          .amplitude_y = amplitude * along,
                          .frequency = settings.number(frequency_key)};
  reject_large_swing(settings, motion.amplitude_x, box.width, "width");
  reject_large_swing(settings, motion.amplitude_y, box.length, "period");
  return motion;
}

/// The key to blame if walls and grains do not fit: the one that was given. If both were, that of
/// the walls, unless a single grain is as large as the `room` (m).
std::string to_blame(const io::Settings& settings, const std::string& key_of_walls,
                     const LargestGrain& largest, double room) {
  const bool by_grains = !settings.given(key_of_walls) || largest.diameter >= room;
  return settings.given(largest.set_by) && by_grains ? largest.set_by : key_of_walls;
}

/// Text for the remedy if a single grain is as large as the `room` (m), or "".
std::string hint(const LargestGrain& largest, double room) {
  if (largest.diameter < room) return "";
  const bool by_file = largest.set_by != std::string_view("grains.diameter");
  return fmt::format("; is a unit forgotten, as in '{}'?", by_file ? "diameter (mm)" : "1 mm");
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
              "number of them fits the length ('riesel check' tells what comes out).",
       .only_when = corrugated},
      {.key = amplitude_key,
       .unit = "m",
       .fallback = "0",
       .range = io::non_negative(),
       .doc = "Amplitude of the shaking of the walls, to either side; all walls shake alike."},
      {.key = frequency_key,
       .unit = "1/s",
       .fallback = "0",
       .range = io::non_negative(),
       .doc = "Frequency of the shaking, f in sin(2 pi f t)."},
      {.key = angle_key,
       .unit = "rad",
       .fallback = "0",
       .range = io::between(-0.5 * pi, 0.5 * pi),
       .doc = "Direction of the shaking: 0 along the walls, 90 degrees across them."},
  };
}

Direction direction(double angle) {
  constexpr double rounding = 1e-12;
  const bool right = std::abs(std::abs(angle) - 0.5 * pi) < rounding;
  return {.along = right ? 0.0 : std::cos(angle),
          .across = right ? std::copysign(1.0, angle) : std::sin(angle)};
}

WallLattice wall_at(double line, const io::Settings& settings, const Box& box,
                    const std::string& key_of_length) {
  const WallMotion motion = shaking(settings, box);
  if (settings.text("wall.surface") == "smooth") return WallLattice::smooth_at(line, motion);
  const double spacing = settings.number("wall.spacing");
  if (spacing > box.length)
    settings.reject("wall.spacing", "wider than the walls are long",
                    "choose it below " + key_of_length);
  return {.line = line,
          .radius = 0.5 * settings.number("wall.grain_diameter"),
          .count = std::llround(box.length / spacing),
          .motion = motion};
}

void reject_short_period(const io::Settings& settings, const LargestGrain& largest,
                         const State& empty, const std::string& key_of_length) {
  const double length = empty.box.length;
  if (length < 4.0 * largest.diameter * (1.0 - 1e-12))
    settings.reject(to_blame(settings, key_of_length, largest, length),
                    fmt::format("the periodic {} is too short for grains of this size",
                                io::section_of(key_of_length)),
                    fmt::format("choose smaller grains, or for {} at least four diameters, "
                                "{:.6g} m{}",
                                key_of_length, 4.0 * largest.diameter, hint(largest, length)));
  const double most = 0.5 * length - largest.diameter;
  if (2.0 * std::ranges::max(empty.walls, {}, &WallLattice::radius).radius > most)
    settings.reject(
        "wall.grain_diameter",
        fmt::format("too large for a periodic {} of this length", io::section_of(key_of_length)),
        fmt::format("choose at most {:.6g} m; is a unit forgotten, as in '0.66 mm'?", most));
  for (const WallLattice& wall : empty.walls)
    if (!wall.smooth())
      reject_crowded_wall(settings, 0.5 * largest.diameter + wall.radius, wall.spacing(empty.box));
}

void reject_small_space(const io::Settings& settings, const LargestGrain& largest,
                        const State& empty, const std::string& section) {
  reject_short_period(settings, largest, empty, section + ".length");
  const std::string key_of_width = section + ".width";
  const double needed = largest.diameter + (empty.walls.front().radius + empty.walls.back().radius);
  if (empty.box.width < needed)
    settings.reject(
        to_blame(settings, key_of_width, largest, empty.box.width),
        fmt::format("the {} is too narrow for the grains between the wall grains", section),
        fmt::format("choose smaller grains, or {} above {:.6g} m{}", key_of_width, needed,
                    hint(largest, empty.box.width)));
}

void reject_crowded_wall(const io::Settings& settings, double reach, double spacing) {
  const double least = WallLattice::least_spacing(reach);
  if (spacing < least)
    settings.reject("wall.spacing", "too close together for grains of this size",
                    fmt::format("choose at least {:.3g} m; is a unit forgotten, as in '1.2 mm'?",
                                least * (1.0 + 1e-2)));
}

void reject_fast_walls(const io::Settings& settings, const State& state) {
  constexpr double fewest_steps = 20.0;  // per period: with fewer, walls do not shake as set
  const double largest = largest_speed(state.box, state.time_step, 1);
  for (const WallLattice& wall : state.walls) {
    const double shaken = wall.motion.fastest_oscillation(),
                 steady = std::abs(wall.motion.velocity);
    if (steady + shaken >= largest)
      settings.reject(shaken > steady ? frequency_key : "cell.velocity",
                      "moves a wall too fast for this time step",
                      fmt::format("choose a velocity of the wall below {:.3g} m/s", largest));
    const double periods = wall.motion.frequency * state.time_step;  // per step
    if (shaken > 0.0 && periods * fewest_steps > 1.0)
      settings.reject(frequency_key,
                      fmt::format("gives {:.3g} time steps per period; at least {:g} are needed",
                                  1.0 / periods, fewest_steps),
                      fmt::format("choose at most {:.3g} 1/s, or more run.steps_per_collision",
                                  0.99 / (fewest_steps * state.time_step)));
    if (wall.smooth()) continue;
    // Else a grain would not meet one wall grain after the other.
    const double spacing = wall.spacing(state.box);
    const double followed = spacing / (fewest_steps * state.time_step);
    if (steady + shaken > followed)
      settings.reject(shaken > steady ? frequency_key : "cell.velocity",
                      fmt::format("moves a wall by {:.3g} of the distance of its grains in a time "
                                  "step; at most 1/{:g} is followed",
                                  (steady + shaken) * state.time_step / spacing, fewest_steps),
                      fmt::format("choose a velocity of the wall of at most {:.3g} m/s, or more "
                                  "run.steps_per_collision",
                                  followed));
  }
}

namespace {

/// What walls do again and again.
struct Rhythm {
  double frequency;       ///< 1/s
  int most_refused;       ///< so many of its phases are too few
  std::string_view name;  ///< for messages
};

/// As measured (docs/physics.md), the mean temperature of a shaken bed is off by a half with one
/// phase, by a seventh with two, by a hundredth with four, and not measurably with more. Two
/// corrugated walls that move past each other stand as before after each spacing: in a narrow cell
/// the temperature is off by a half with one phase, by an eighth with two, and hardly with three.
std::vector<Rhythm> rhythms(const State& state) {
  const WallLattice &first = state.walls.front(), &last = state.walls.back();
  std::vector<Rhythm> rhythms;
  if (first.motion.oscillates()) rhythms.push_back({first.motion.frequency, 4, "an oscillation"});
  const double passing = std::abs(last.motion.velocity - first.motion.velocity);
  if (passing > 0.0 && !first.smooth() && !last.smooth())
    rhythms.push_back(
        {passing / first.spacing(state.box), 2, "the wall grains that pass each other"});
  return rhythms;
}

/// The number of phases of a rhythm that rows see if they are this long (s) apart. Nothing if these
/// are enough, or drift enough during the run to cover others.
std::optional<int> phases_seen(const Rhythm& rhythm, double row, double rows) {
  constexpr double too_few_rows = 20.0;  // for a mean, whatever they see
  constexpr double wandering = 2.0;      // drift in the whole run, in distances between phases
  if (rows < too_few_rows) return {};
  for (int phases = 1; phases <= rhythm.most_refused; ++phases) {
    const double periods = phases * rhythm.frequency * row, whole = std::nearbyint(periods);
    if (whole >= 1.0 && std::abs(periods - whole) * rows < wandering) return phases;
  }
  return {};
}

/// A rhythm of the walls of which rows see only these phases.
struct InStep {
  Rhythm rhythm;
  int phases;
};

std::optional<InStep> in_step(const State& state, const RunLength& length, double interval) {
  const double row =
      static_cast<double>(steps_between(interval, state.time_step)) * state.time_step;
  double rows = length.at_most / row;
  if (length.relative_error) rows = std::min(rows, double{fewest_samples_to_stop});
  for (const Rhythm& rhythm : rhythms(state))
    if (const auto phases = phases_seen(rhythm, row, rows)) return InStep{rhythm, *phases};
  return {};
}

}  // namespace

void reject_rows_in_step(const io::Settings& settings, const State& state) {
  constexpr auto key = "output.interval";
  const RunLength length = run_length(settings);
  const double asked = settings.number(key);
  const auto found = in_step(state, length, asked);
  if (!found) return;
  double interval = asked;
  std::string other;  // as it is printed: the rounded value must be good, too
  do {
    interval *= 0.93;
    other = fmt::format("{:.3g}", interval);
  } while (in_step(state, length, io::decimal_value(other).value()));
  settings.reject(
      key,
      fmt::format("in step with the walls: rows {:.4g} s apart sample only {} phase{} of {} at "
                  "{:.4g} 1/s, so that means over rows would describe only {}",
                  asked, found->phases, found->phases == 1 ? "" : "s", found->rhythm.name,
                  found->rhythm.frequency, found->phases == 1 ? "that one" : "these"),
      fmt::format("choose {} s, for example{}", other,
                  state.step > 0 ? ", in a new run: this one has its rows" : ""));
}

}  // namespace riesel::scenarios
