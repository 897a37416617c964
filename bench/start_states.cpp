#include "bench/start_states.hpp"

#include "bench/timing.hpp"
#include "engine/hash.hpp"
#include "engine/observables.hpp"
#include "engine/random.hpp"
#include "io/checkpoint.hpp"
#include "io/file_error.hpp"
#include "scenarios/scenario.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace riesel::bench {

namespace {

/// To be raised when states are made differently: it goes into their names.
constexpr int recipe = 1;

io::Settings read_settings(const FlowCase& one, const std::vector<std::string>& overrides) {
  return io::Settings::from_text(one.settings, one.name, scenarios::settings_tables(), overrides);
}

scenarios::Flow fresh(const io::Settings& settings) {
  return std::get<scenarios::Flow>(scenarios::problem_of(settings));
}

std::uint64_t fingerprint(const FlowCase& one, const io::Settings& settings) {
  Hash hash;
  hash.add(recipe);
  hash.add(one.relaxation);
  hash.add_text(settings.effective_yaml());
  return hash.value();
}

void tell(const std::string& name, const State& state, double seconds) {
  const Observables now = observe(state);
  fmt::print(stderr,
             "  {}: {} grains at t = {:.3g} s, mean v_y = {:.4g} m/s, thermal velocity {:.3g} m/s, "
             "{:.3g} contacts per grain; made in {:.1f} s\n",
             name, state.grains.size(), now.time, now.mean_vy, std::sqrt(now.granular_temperature),
             now.contacts, seconds);
}

void keep(const std::filesystem::path& path, const io::Settings& settings, State state) {
  std::filesystem::create_directories(path.parent_path());
  io::write_checkpoint(path, {.state = std::move(state),
                              .settings = settings.effective_yaml(),
                              .source = settings.source_text()});
}

/// Whether a kept state can be read. Another build may have left it, or an interruption: then it
/// goes, to be made anew.
bool is_usable(const std::filesystem::path& path) {
  try {
    io::read_checkpoint(path);
    return true;
  } catch (const io::FileError& error) {
    fmt::print(stderr, "  {}: {}; made anew\n", path.filename().string(), error.problem());
    std::filesystem::remove(path);
    return false;
  }
}

/// Steps `state` for `time` (s), and tells twice how it goes: a steady flow says the same.
State relaxed(const std::string& name, State state, const ContactModel& model, double time) {
  Simulation simulation(std::move(state), model, 1);
  const auto steps = std::llround(time / simulation.state().time_step);
  for (const std::int64_t part : {steps - steps / 2, steps / 2}) {
    const double seconds = seconds_of([&] { simulation.advance(part); });
    tell(name, simulation.state(), seconds);
  }
  return simulation.state();
}

/// Until the copies have forgotten each other: a millisecond, in which a grain of the slow tube
/// flies a third of its diameter, less where that takes too long.
State forgotten(const std::string& name, State state, const ContactModel& model) {
  constexpr double enough_time = 1e-3, most_work = 5e8;  // s, particle-steps
  const auto grains = static_cast<double>(state.grains.size());
  const double steps = std::min(enough_time / state.time_step, std::max(100.0, most_work / grains));
  Simulation simulation(std::move(state), model, 1);
  const double seconds = seconds_of([&] { simulation.advance(static_cast<std::int64_t>(steps)); });
  tell(name, simulation.state(), seconds);
  return simulation.state();
}

}  // namespace

io::Settings settings_of(const FlowCase& one, const Size& size,
                         const std::vector<std::string>& overrides) {
  io::Settings tile = read_settings(one, overrides);
  if (size.copies == 1) return tile;
  const double length = tile.number("tube.length");
  const double spacing = length / std::round(length / tile.number("wall.spacing"));
  std::vector<std::string> all = overrides;
  all.push_back(fmt::format("tube.length={:.17g}", length * size.copies));
  all.push_back(fmt::format("wall.spacing={:.17g}", spacing));
  return read_settings(one, all);
}

State repeated(const State& tile, int copies) {
  State result;
  result.box = {.width = tile.box.width, .length = tile.box.length * copies};
  result.walls = tile.walls;
  for (WallLattice& wall : result.walls) wall.count *= copies;
  result.gravity = tile.gravity;
  result.time_step = tile.time_step;

  const double change = 0.1 * std::sqrt(observe(tile).granular_temperature);
  const RandomStream stream(1, Use::velocity);
  for (int copy = 0; copy < copies; ++copy)
    for (std::size_t slot = 0; slot < tile.grains.size(); ++slot) {
      Grain grain = grain_at(tile, slot);
      const auto [vx, vy] = stream.normal(result.grains.size());
      grain.y += copy * tile.box.length;
      grain.vx += change * vx;
      grain.vy += change * vy;
      add_grain(result, grain);
    }
  return result;
}

std::filesystem::path StartStates::checkpoint(const FlowCase& one, const Size& size,
                                              const std::vector<std::string>& overrides) const {
  const io::Settings settings = settings_of(one, size, overrides);
  const std::string name = fmt::format("{}-{}", one.name, size.name);
  auto path = folder_ / fmt::format("{}-{:016x}.h5", name, fingerprint(one, settings));
  if (std::filesystem::exists(path) && is_usable(path)) return path;

  if (one.relaxation == 0.0) {
    keep(path, settings, fresh(settings).state);
  } else if (size.copies == 1) {
    const scenarios::Flow flow = fresh(settings);
    keep(path, settings, relaxed(name, flow.state, flow.model, one.relaxation));
  } else {
    const auto tile = io::read_checkpoint(checkpoint(one, {"1.4k", 1}, overrides));
    keep(path, settings,
         forgotten(name, repeated(tile.state, size.copies), scenarios::contact_model(settings)));
  }
  return path;
}

}  // namespace riesel::bench
