// run.h5 read back: what was written is there, and what is damaged is refused.
#include "io/run_reader.hpp"

#include "io/build_info.hpp"
#include "io/file_error.hpp"
#include "tests/io/file_fixture.hpp"
#include "tests/tables_of_a_flow.hpp"

#include <cmath>
#include <cstdint>
#include <stdexcept>

using namespace riesel;
using namespace riesel::io;
using namespace file_fixture;

namespace {

const Strips strips{.width = 1e-3, .length = 0.1, .count = 2};

/// Of each the value 1 in the first strip, and in the second nothing that is known.
std::vector<TubeProfile> profiles() {
  return profiles_like(
      {.name = {},
       .unit = "unit",
       .meaning = "Meaning.",
       .zones = {{.value = 1.0, .error = 0.1}, {.value = std::nan(""), .error = std::nan("")}}});
}

/// Of each two bins: one contact in two seconds in the first, and nothing that is known of the
/// second.
std::vector<HistogramTable> histograms() {
  return histograms_like(
      {.name = {},
       .unit = "unit",
       .meaning = "Meaning.",
       .lower_edges = {1.0, 2.0},
       .counts = {1, 0},
       .rates = {{.value = 0.5, .error = 0.1}, {.value = std::nan(""), .error = std::nan("")}}});
}

const Window window{.since = 0.1, .state = SteadyVerdict::steady};

/// 5 N, 10 N, ...
std::vector<PresentForce> forces_of(const State& state) {
  std::vector<PresentForce> forces;
  for (double n = 1.0; forces.size() < state.contacts.size(); ++n)
    forces.push_back({.x = 0.0, .branch_x = 0.0, .branch_y = 0.0, .fx = -3.0 * n, .fy = 4.0 * n});
  return forces;
}

RunFile write_run(const fs::path& path, const State& state) {
  auto file = RunFile::create(
      path, {{"date", "today"}, {"command", "riesel run"}, {"settings", "a: 1"}, {"run", "1f"}},
      columns);
  for (int i = 0; i < 3; ++i) file.append(std::vector{0.1 * i, -1.0 / (i + 1)});
  file.write_final_state(state, forces_of(state));
  file.write_profiles(strips, profiles(), window);
  file.write_histograms(histograms(), window);
  file.flush();
  return file;
}

std::string complaint(const fs::path& path) {
  return message_of<FileError>([&] { read_run_file(path); });
}

}  // namespace

TEST_CASE("What was written to a run file is read back") {
  const ScratchDirectory directory;
  const auto path = directory / run_file_name;
  const State state = special_state();
  write_run(path, reversed(state));
  const auto run = read_run_file(path);

  CHECK(run.final_state.box.width == state.box.width);
  CHECK(run.final_state.box.length == state.box.length);
  CHECK(run.final_state.step == state.step);
  CHECK(run.final_state.time == state.time());
  REQUIRE(run.final_state.grains.size() == state.grains.size());
  for (std::size_t i = 0; i < state.grains.size(); ++i) {
    const Grain expected = grain_at(state, i);
    const Grain& found = run.final_state.grains[i];
    CHECK(std::vector{found.x, found.y, found.vx, found.vy, found.radius, found.mass}
          == std::vector{expected.x, expected.y, expected.vx, expected.vy, expected.radius,
                         expected.mass});
  }
  REQUIRE(run.final_state.walls.size() == 2);
  CHECK(run.final_state.walls[0].radius == state.walls[0].radius);
  CHECK(run.final_state.walls[0].count == 83);
  REQUIRE(run.final_state.contacts.size() == state.contacts.size());
  REQUIRE(run.final_state.forces.size() == state.contacts.size());
  for (std::size_t i = 0; i < state.contacts.size(); ++i) {
    CHECK((run.final_state.contacts[i] == state.contacts[i].name));
    CHECK(run.final_state.forces[i] == 5.0 * static_cast<double>(i + 1));
  }

  CHECK(run.series.size() == 2);
  CHECK(run.series_of("velocity").column.unit == "m/s");
  CHECK(run.series_of("velocity").column.doc == "Mean axial velocity.");
  CHECK(run.series_of("velocity").values == std::vector{-1.0, -1.0 / 2, -1.0 / 3});
  CHECK_THROWS_AS(run.series_of("speed"), std::out_of_range);
  CHECK(run.profiles.x == std::vector{0.5e-3, 1.5e-3});
  const ProfileWithErrors& stress = run.profiles.named("stress_xy");
  CHECK(stress.column.unit == "unit");
  CHECK(stress.values.front() == 1.0);
  CHECK(stress.errors.front() == 0.1);
  CHECK(std::isnan(stress.values.back()));
  CHECK_THROWS_AS(run.profiles.named("density"), std::out_of_range);
  const HistogramWithErrors& overlaps = run.histogram_of("wall_contact_overlap");
  CHECK(overlaps.column.unit == "unit");
  CHECK(overlaps.column.doc == "Meaning.");
  CHECK(overlaps.lower_edges == std::vector{1.0, 2.0});
  CHECK(overlaps.rates.front() == 0.5);
  CHECK(overlaps.errors.front() == 0.1);
  CHECK(std::isnan(overlaps.rates.back()));
  CHECK_THROWS_AS(run.histogram_of("wall_visit_entry_rate"), std::out_of_range);
  CHECK(run.history.start == Provenance{{"date", "today"}, {"command", "riesel run"}});
  CHECK(run.history.resumes.empty());
}

TEST_CASE("Each resume of a run is told of") {
  const ScratchDirectory directory;
  const auto path = directory / run_file_name;
  write_run(path, special_state());
  for (const std::string day : {"tomorrow", "later"}) {
    auto file = RunFile::reopen(path, {{"date", day}, {"run", "1f"}}, columns, 3);
    file.write_final_state(special_state(), forces_of(special_state()));
    file.write_profiles(strips, profiles(), window);
    file.write_histograms(histograms(), window);
    file.flush();
  }
  const auto run = read_run_file(path);
  CHECK(run.history.resumes
        == std::vector<Provenance>{{{"date", "tomorrow"}}, {{"date", "later"}}});
}

TEST_CASE("A run file that is damaged or no record of a flow is refused") {
  const ScratchDirectory directory;
  const auto path = directory / run_file_name;
  CHECK(complaint(path).find("run.h5: ") != std::string::npos);
  overwrite(path, "no HDF5 at all");
  CHECK(complaint(path).find("is damaged") != std::string::npos);
  fs::remove(path);

  RunFile::create(path, {}, columns).flush();
  CHECK(complaint(path).find("no final state") != std::string::npos);
  fs::remove(path);

  write_run(path, special_state());
  CHECK(complaint(path).empty());
  const auto whole = contents(path);
  for (const std::size_t part : {1U, 2U, 3U}) {
    overwrite(path, whole.substr(0, part * whole.size() / 4));
    CHECK(complaint(path).find("is damaged") != std::string::npos);
  }
}

TEST_CASE("A run file of another version that does not fit is told with that version") {
  const ScratchDirectory directory;
  const auto path = directory / run_file_name;
  const auto complaint_of = [&](const std::string& version) {
    fs::remove(path);
    RunFile::create(path, {{"riesel_version", version}}, columns).flush();
    return complaint(path);
  };
  const std::string old = complaint_of("0.5.0");
  CHECK(old.find("does not fit this version of riesel (it holds no final state); use riesel 0.5.0")
        != std::string::npos);
  CHECK(complaint_of(std::string(build_info().version)).find("is damaged") != std::string::npos);
}

TEST_CASE("One wrong bit in a run file is told") {
  const ScratchDirectory directory;
  const auto path = directory / run_file_name;
  write_run(path, special_state());
  auto bytes = contents(path);
  const auto place =
      bytes.find("riesel run", 512);  // of the provenance, which has no checksum of its own
  REQUIRE(place != std::string::npos);
  bytes[place] = static_cast<char>(bytes[place] ^ 1);
  overwrite(path, bytes);
  CHECK(complaint(path).find("(its length or checksum is wrong)") != std::string::npos);
}

TEST_CASE("Histograms that cannot be are refused") {
  const ScratchDirectory directory;
  const auto refused = [&](const char* name, auto spoil) {
    auto file = write_run(directory / name, special_state());
    auto spoilt = histograms();
    spoil(spoilt[2]);
    file.write_histograms(spoilt, window);
    file.flush();
    return complaint(directory / name).find("grain_contact_overlap has impossible bins")
           != std::string::npos;
  };
  CHECK_FALSE(refused("a.h5", [](HistogramTable&) {}));
  CHECK(refused("b.h5", [](HistogramTable& h) { h.lower_edges[0] = 0.0; }));
  CHECK(refused("c.h5", [](HistogramTable& h) { h.lower_edges[0] = 3.0; }));
  CHECK(refused("d.h5", [](HistogramTable& h) { h.rates.pop_back(); }));
}

TEST_CASE("A final state that cannot be is refused") {
  const ScratchDirectory directory;
  const auto refused = [&](const char* name, auto spoil) {
    State state = special_state();
    spoil(state);
    write_run(directory / name, state);
    return complaint(directory / name);
  };
  CHECK(refused("a.h5", [](State& s) { s.contacts[0].name.partner = 4; }).find("bodies")
        != std::string::npos);
  CHECK(refused("b.h5", [](State& s) { s.contacts[2].name.partner = 83; }).find("bodies")
        != std::string::npos);
  CHECK(refused("c.h5", [](State& s) { s.grains.radius[1] = -1.0; }).find("a grain")
        != std::string::npos);
  CHECK(refused("d.h5", [](State& s) { s.walls[0].count = 0; }).find("wall") != std::string::npos);
  CHECK(refused("e.h5", [](State& s) { s.box.length = 0.0; }).find("box") != std::string::npos);
  const auto timeless = [](State& s) { s.time_step = std::numeric_limits<double>::infinity(); };
  const auto far_away = [](State& s) {
    s.walls[0].motion.velocity = 1e308;
    s.time_step = 1e3;
  };
  REQUIRE(special_state().step > 0);
  CHECK(refused("f.h5", [](State&) {}).empty());
  CHECK(refused("g.h5", timeless).find("its time is not finite") != std::string::npos);
  CHECK(refused("h.h5", far_away).find("a wall has impossible values") != std::string::npos);
}
