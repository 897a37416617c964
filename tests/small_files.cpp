#include "tests/small_files.hpp"

#include "engine/histogram_blocks.hpp"
#include "engine/simulation.hpp"
#include "io/checkpoint.hpp"
#include "io/settings.hpp"
#include "io/trajectory_file.hpp"
#include "scenarios/scenario.hpp"
#include "tests/scratch_directory.hpp"
#include "tests/tables_of_a_flow.hpp"

#include <cstdint>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <variant>

namespace riesel {

namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t run_of_trajectory = 0x1f;
constexpr std::int64_t steps_per_frame = 10;

State state_of_a_small_tube() {
  const auto settings = io::Settings::from_text("scenario: periodic_tube\n"
                                                "contact: {stiffness: 2000 N/m, restitution: 0.9}\n"
                                                "grains: {area_fraction: 0.4}\n"
                                                "tube: {width: 4 mm, length: 5 mm}\n"
                                                "start: {random_velocity: 2 m/s}\n"
                                                "run: {duration: 5 ms}\n",
                                                "tube.yaml", scenarios::settings_tables());
  auto problem = scenarios::problem_of(settings);
  auto& flow = std::get<scenarios::Flow>(problem);
  Simulation simulation(std::move(flow.state), flow.model, 1);
  do simulation.advance(100);
  while (simulation.state().contacts.size() < 2 || simulation.state().open_visits.empty());
  return simulation.state();
}

constexpr int small_rows = 3;

TimeBlocks small_histograms() {
  const std::size_t columns = HistogramBlocks().blocks().columns();
  return {columns, small_rows, 4, std::vector(columns, 1.0)};
}

}  // namespace

const std::vector<io::Column> small_columns = {{"time", "s", "t"}, {"velocity", "m/s", "v"}};

void write_small_checkpoint(const fs::path& path) {
  io::write_checkpoint(path, {.state = state_of_a_small_tube(),
                              .settings = "scenario: periodic_tube\n",
                              .source = "# mine\n",
                              .rows = small_rows,
                              .wall_seconds = 0.1,
                              .profiles = TimeBlocks(1, small_rows, 2, {1.0, 2.0}),
                              .histograms = small_histograms()});
}

void write_small_run_file(const fs::path& path) {
  auto file = io::RunFile::create(path, {{"date", "today"}, {"settings", "a: 1"}, {"run", "1f"}},
                                  small_columns);
  for (int i = 0; i < small_rows; ++i) file.append(std::vector{0.1 * i, -1.0});
  const State state = state_of_a_small_tube();
  file.write_final_state(state, std::vector<PresentForce>(state.contacts.size()));
  file.write_profiles({.width = 1e-3, .length = 0.1, .count = 2},
                      profiles_like({.name = {}, .unit = "1", .meaning = "m", .zones = {{}, {}}}),
                      {.since = 0.1, .state = SteadyVerdict::steady});
  file.write_histograms(histograms_like({.name = {},
                                         .unit = "1",
                                         .meaning = "m",
                                         .lower_edges = {1.0, 2.0},
                                         .counts = {1, 0},
                                         .rates = {{}, {}}}),
                        {.since = 0.1, .state = SteadyVerdict::steady});
  file.flush();
}

void write_small_trajectory(const fs::path& path) {
  State state = state_of_a_small_tube();
  state.step = 0;
  auto file = io::TrajectoryFile::create(path, run_of_trajectory, state, steps_per_frame, "a: 1\n");
  for (int i = 0; i < 3; ++i) file.append(state);
  file.commit();
}

void reopen_small_trajectory(const fs::path& path) {
  static const State after_a_frame = [] {
    State state = state_of_a_small_tube();
    state.step = steps_per_frame;
    return state;
  }();
  io::TrajectoryFile::reopen(path, run_of_trajectory, after_a_frame, steps_per_frame, "a: 1\n");
}

std::vector<char> small_file(void (*write)(const fs::path&)) {
  const ScratchDirectory directory;
  const auto path = directory / "file.h5";
  write(path);
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace riesel
