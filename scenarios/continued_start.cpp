#include "scenarios/continued_start.hpp"

#include "engine/encounter.hpp"
#include "engine/observables.hpp"
#include "io/content_hash.hpp"
#include "io/file_error.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <variant>
#include <vector>

namespace riesel::scenarios {

namespace {

constexpr auto from_key = "start.from";
constexpr std::array carried_sections = {"grains", "wall", "tube", "chute", "cell"};

io::FoundCheckpoint find(const io::Settings& settings) {
  try {
    return io::find_checkpoint(settings.text(from_key));
  } catch (const io::FileError& error) {
    settings.reject(from_key, fmt::format("no state can be read ({})", error.what()),
                    "give the directory of a run that has come to its end, or its checkpoint.h5");
  }
}

/// Rejects a run whose newest checkpoint cannot be read: starting from the previous one would give
/// another result with the same settings.
io::Checkpoint checkpoint_of(const io::Settings& settings) {
  io::FoundCheckpoint found = find(settings);
  if (!found.note.empty())
    settings.reject(from_key, fmt::format("its newest state cannot be read ({})", found.note),
                    "make that run again, or name the state before: " + found.path.string());
  return std::move(found.checkpoint);
}

/// Whether the earlier run was set the same. Files count by their contents, as far as they are
/// still there: the earlier run gives what it has read from them.
bool is_as_before(const io::Setting& row, const io::Settings& settings,
                  const io::Settings& earlier) {
  if (settings.written(row.key) == earlier.written(row.key)) return true;
  if (!row.names_content || !settings.has(row.key)) return false;
  const std::string& before = earlier.text(row.key);
  std::error_code out_of_reach;
  return !std::filesystem::exists(before, out_of_reach)
         || io::hash_of_content(settings.text(row.key)) == io::hash_of_content(before);
}

/// Rejects settings that differ from those of the earlier run, but would have no effect as the
/// earlier run gives what they set.
void reject_other_grains_or_tube(const io::Settings& settings, const io::Settings& earlier) {
  for (const auto& row : settings_tables().at(settings.scenario())) {
    const std::string section = io::section_of(row.key);
    const bool carried_over = std::ranges::count(carried_sections, section) > 0;
    if (!carried_over || can_continue_along(row.key) || !earlier.has(row.key)  // it used a file
        || is_as_before(row, settings, earlier))
      continue;
    settings.reject(row.key,
                    fmt::format("is {} here and {} in the run to be continued",
                                settings.written(row.key), earlier.written(row.key)),
                    "make both equal: grains and tube are those of the earlier run");
  }
}

/// The contact as the new run sees it: the clock starts at `now` (s), and what the contact has done
/// so far belongs to the earlier run.
Contact carried_over(const Contact& contact, double now, const ContactModel& model) {
  const auto stored = [&](const auto& normal) { return normal.stored_energy(contact.overlap); };
  const auto* spring = std::get_if<SpringSlip>(&model.slip);
  const double elongation = spring != nullptr ? contact.spring : 0.0;
  return {.name = contact.name,
          .begin = contact.begin - now,
          .end = contact.end - now,
          .entry_rate = contact.entry_rate,
          .entry_slip = contact.entry_slip,
          .overlap = contact.overlap,
          .max_overlap = contact.overlap,
          .elastic_energy = std::visit(stored, model.normal)
                            + (spring != nullptr ? spring->stored_energy(elongation) : 0.0),
          .friction_x = contact.friction_x,
          .friction_y = contact.friction_y,
          .spring = elongation,
          .torque = contact.torque,
          .rolling_torque = contact.rolling_torque};
}

/// Sets `motion` so that the wall is where it was, at the same phase of its oscillation.
void go_on_from(const WallMotion& before, const State& earlier, WallMotion& motion) {
  motion.phase = std::fmod(before.phase_at(earlier.time()), 2.0 * std::numbers::pi);
  const auto y_of = [&](const WallMotion& m, std::int64_t step) {
    return m.shift(earlier.box, earlier.time_step, step).y;
  };
  motion.start = wrapped_difference(y_of(before, earlier.step), y_of(motion, 0));
}

/// J, of the motion relative to the mean velocity.
double energy_of_fluctuations(const State& state) {
  const GrainView grains(state);
  double mass = 0.0, px = 0.0, py = 0.0, twice_energy = 0.0;
  for (std::size_t i = 0; i < state.grains.size(); ++i) {
    const Grain g = grains[i];
    mass += g.mass;
    px += g.mass * g.vx;
    py += g.mass * g.vy;
    twice_energy += g.mass * (g.vx * g.vx + g.vy * g.vy);
  }
  return 0.5 * (twice_energy - (px * px + py * py) / mass);
}

bool alike(double a, double b) {
  constexpr double rounding = 1e-12;  // of settings that were converted, and of sines of angles
  return std::abs(a - b) <= rounding * std::max(std::abs(a), std::abs(b));
}

bool alike(const WallLattice& a, const WallLattice& b) {
  return alike(a.line, b.line) && alike(a.radius, b.radius) && a.count == b.count;
}

/// Places are in quanta of the box, so it must be the same. Compares the boxes themselves, as for
/// scenarios from outside the settings that define them are not known here.
void reject_other_box(const io::Settings& settings, const State& earlier, const State& empty) {
  if (alike(earlier.box.width, empty.box.width) && alike(earlier.box.length, empty.box.length)
      && std::ranges::equal(earlier.walls, empty.walls,
                            [](const auto& a, const auto& b) { return alike(a, b); }))
    return;
  settings.reject(from_key, "has a state in another box or between other walls than these settings",
                  "make them equal: box and walls are those of the earlier run");
}

}  // namespace

io::Checkpoint earlier_run(const io::Settings& settings, const State& empty) {
  io::Checkpoint checkpoint = checkpoint_of(settings);
  const auto earlier =
      io::Settings::from_text(checkpoint.settings, settings.text(from_key), settings_tables());
  if (earlier.scenario() != settings.scenario())
    settings.reject(from_key, "is a run of the scenario " + earlier.scenario(),
                    "give a run of the scenario " + settings.scenario());
  reject_other_grains_or_tube(settings, earlier);
  if (const std::size_t walls = checkpoint.state.walls.size(); walls != empty.walls.size())
    settings.reject(from_key,
                    fmt::format("has a state with {} wall{}, and {} has {}", walls,
                                walls == 1 ? "" : "s", settings.scenario(), empty.walls.size()),
                    "give the checkpoint.h5 that a run of this scenario has written");
  reject_other_box(settings, checkpoint.state, empty);
  return checkpoint;
}

std::vector<double> swings_across(const State& state) {
  std::vector<double> swings;
  for (const WallLattice& wall : state.walls) swings.push_back(wall.motion.amplitude_x);
  return swings;
}

Flow::Earlier to_be_continued(const io::Checkpoint& earlier) {
  const State& state = earlier.state;
  return {.identity = fmt::format("run {:016x} at t = {} s (step {}), state hash {:016x}",
                                  earlier.run, state.time(), state.step, state_hash(state)),
          .swings_across = swings_across(state),
          .elastic_energy = observe(state).energies.elastic,
          .random_energy = energy_of_fluctuations(state)};
}

void reject_other_swing_across(const io::Settings& settings, const std::vector<double>& earlier,
                               const State& state) {
  for (std::size_t wall = 0; wall < state.walls.size(); ++wall)
    if (const double before = earlier[wall], now = state.walls[wall].motion.amplitude_x;
        !alike(now, before))
      settings.reject(
          "wall.shake_amplitude",
          fmt::format("shakes the walls across with amplitude {:.6g} m, the run to be continued "
                      "with {:.6g} m",
                      now, before),
          "make the transverse amplitudes equal (by amplitude and angle), or start afresh");
}

void reject_released_energy(const io::Settings& settings, const Flow::Earlier& earlier,
                            const State& state) {
  const double before = earlier.elastic_energy;
  const double now = observe(state).energies.elastic;
  const double had = before + earlier.random_energy;
  if (now - before <= had) return;
  settings.reject("contact.stiffness",
                  fmt::format("the overlaps of the run to be continued hold {:.3g} J with this "
                              "contact law, and held {:.3g} J: they would release more energy than "
                              "there was in overlaps and random motion, {:.3g} J",
                              now, before, had),
                  "go there in several runs, each stiffer by a factor of a few "
                  "(continue_along: contact.stiffness), or start afresh");
}

std::vector<Grain> half_a_step_before(const State& earlier, double time_step) {
  const StepUnits units(earlier);
  const double half_step = 0.5 * time_step / earlier.time_step;
  const GrainView grains(earlier);
  std::vector<Grain> result;
  for (std::size_t i = 0; i < earlier.grains.size(); ++i) {
    Grain grain = grains[i];
    grain.vx -= half_step * real(earlier.grains.kick[i].x) * units.velocity_x;
    grain.vy -= half_step * real(earlier.grains.kick[i].y) * units.velocity_y;
    grain.spin -= half_step * real(earlier.grains.spin_kick_of(i)) * units.spin;
    result.push_back(grain);
  }
  return result;
}

void take_over(const State& earlier, const ContactModel& model, State& state) {
  const double steps = state.time_step / earlier.time_step;
  const auto rescaled = [&](Fixed kick) {
    return nearest_fixed(static_cast<double>(kick) * steps * steps);
  };
  const GrainView grains(earlier);
  for (std::size_t i = 0; i < earlier.grains.size(); ++i) {
    add_grain(state, grains[i]);
    Grains& g = state.grains;
    g.position[i] = earlier.grains.position[i];
    g.kick[i] = {rescaled(earlier.grains.kick[i].x), rescaled(earlier.grains.kick[i].y)};
    g.u[i] = wrapped_difference(g.u[i], FixedVector{g.kick[i].x / 2, g.kick[i].y / 2});
    if (!g.rotate()) continue;
    g.spin_kick[i] = rescaled(earlier.grains.spin_kick[i]);
    g.spin[i] -= g.spin_kick[i] / 2;
  }
  for (std::size_t wall = 0; wall < state.walls.size(); ++wall)
    go_on_from(earlier.walls[wall].motion, earlier, state.walls[wall].motion);
  for (const Contact& contact : earlier.contacts)
    state.contacts.push_back(carried_over(contact, earlier.time(), model));
}

bool can_continue_along(const std::string& key) {
  return key == "gravity" || key == "tube.tilt" || key == "chute.inclination"
         || key == "cell.velocity" || key.starts_with("wall.shake_") || key.starts_with("contact.")
         || key.starts_with("run.");
}

}  // namespace riesel::scenarios
