// run.h5: what was flushed is there, whatever becomes of the process; what does not fit is refused.
#include "io/run_file.hpp"

#include "io/file_error.hpp"
#include "io/hdf5_file.hpp"
#include "io/seal.hpp"
#include "tests/io/file_fixture.hpp"

#include <csignal>
#include <map>

using namespace riesel;
using namespace riesel::io;
using namespace file_fixture;

namespace {

const Provenance provenance = {
    {"host", "here"}, {"source", std::string(100'000, 'y')}, {"run", "1f"}};

/// Rows first ... last - 1 of a series with two columns.
void append_rows(RunFile& file, int first, int last) {
  for (int i = first; i < last; ++i) {
    file.append(std::vector{0.1 * i, -1.0 / (i + 1)});
  }
}

std::vector<double> column_of(const fs::path& path, const std::string& name) {
  const auto data = Hdf5File::open(path).root().group("series").data(name);
  std::vector<double> values(data.shape().rows);
  data.read(std::span(values));
  return values;
}

void check_rows(const fs::path& path, int rows) {
  const auto time = column_of(path, "time"), velocity = column_of(path, "velocity");
  REQUIRE(time.size() == static_cast<std::size_t>(rows));
  REQUIRE(velocity.size() == static_cast<std::size_t>(rows));
  bool equal = true;
  for (int i = 0; i < rows; ++i) {
    const auto k = static_cast<std::size_t>(i);
    equal = equal && time[k] == 0.1 * i && velocity[k] == -1.0 / (i + 1);
  }
  CHECK(equal);
}

/// The text with "0" for each digit.
std::string shape_of(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; }, '0');
  return text;
}

template <class T>
std::vector<T> read(const Hdf5Group& group, const std::string& name) {
  const auto data = group.data(name);
  std::vector<T> values(data.shape().rows * data.shape().columns);
  data.read(std::span(values));
  return values;
}

}  // namespace

TEST_CASE("A run file holds its provenance and describes its columns from the beginning") {
  const ScratchDirectory directory;
  const auto path = directory / run_file_name;
  RunFile::create(path, provenance, columns).flush();
  const auto root = Hdf5File::open(path).root();
  CHECK(root.text_attribute("format") == "riesel run");
  CHECK(root.group("provenance").read_text("host", 100) == "here");
  CHECK((root.group("provenance").read_text("source", 200'000) == provenance[1].second));
  const auto velocity = root.group("series").data("velocity");
  CHECK(velocity.shape().rows == 0);
  CHECK(velocity.text_attribute("unit") == "m/s");
  CHECK(velocity.text_attribute("doc") == "Mean axial velocity.");
}

TEST_CASE("A run file on the disk has the rows of the last flush") {
  const ScratchDirectory directory;
  const auto path = directory / run_file_name;
  auto file = RunFile::create(path, provenance, columns);
  append_rows(file, 0, 5);
  file.flush();
  append_rows(file, 5, 3000);
  check_rows(path, 5);
  CHECK(file.rows() == 3000);
  CHECK(file.series("time").size() == 3000);
  CHECK(file.series("time").back() == 0.1 * 2999);
  file.flush();
  check_rows(path, 3000);
  CHECK(directory.names() == std::vector<std::string>{run_file_name});
}

TEST_CASE("A killed process leaves a run file with every flushed row") {
  const ScratchDirectory directory;
  const auto path = directory / run_file_name;
  CHECK(in_other_process([&] {
          auto file = RunFile::create(path, provenance, columns);
          append_rows(file, 0, 2500);
          file.flush();
          append_rows(file, 2500, 4000);
          return kill(getpid(), SIGKILL);
        })
        == 128 + SIGKILL);
  check_rows(path, 2500);
}

TEST_CASE("A run file that cannot be written stays as it was, and can be written later") {
  const ScratchDirectory directory;
  const auto path = directory / run_file_name;
  auto file = RunFile::create(path, provenance, columns);
  append_rows(file, 0, 10);
  file.flush();
  append_rows(file, 10, 20);
  fs::create_directories(directory / "run.h5.tmp" / "in_the_way");
  CHECK_FALSE(message_of<FileError>([&] { file.flush(); }).empty());
  check_rows(path, 10);
  fs::remove_all(directory / "run.h5.tmp");
  file.flush();
  check_rows(path, 20);
}

TEST_CASE("A run file goes on from the rows that the checkpoint expects") {
  const ScratchDirectory directory;
  const auto path = directory / run_file_name;
  const auto rows = GENERATE(0, 1, 1023, 1024, 1500, 2000);
  {
    auto file = RunFile::create(path, provenance, columns);
    append_rows(file, 0, 2000);
    file.write_final_state({}, {});
    file.flush();
  }
  auto file = RunFile::reopen(path, {{"host", "there"}, {"run", "1f"}}, columns, rows);
  check_rows(path, 2000);  // not changed before the next flush
  append_rows(file, rows, 2100);
  file.flush();
  check_rows(path, 2100);
  const auto origin = Hdf5File::open(path).root().group("provenance");
  CHECK(origin.read_text("host", 100) == "here");
  CHECK(origin.group("resume_1").read_text("host", 100) == "there");
  CHECK_FALSE(Hdf5File::open(path).root().has("final"));
}

TEST_CASE("Two run files can be open at the same time") {
  const ScratchDirectory directory;
  auto a = RunFile::create(directory / "a.h5", provenance, columns);
  auto b = RunFile::create(directory / "b.h5", provenance, columns);
  append_rows(a, 0, 10);
  append_rows(b, 0, 20);
  a.flush();
  b.flush();
  check_rows(directory / "a.h5", 10);
  check_rows(directory / "b.h5", 20);
}

TEST_CASE("Each resume of a run file is recorded") {
  const ScratchDirectory directory;
  const auto path = directory / run_file_name;
  RunFile::create(path, provenance, columns).flush();
  RunFile::reopen(path, {{"host", "b"}, {"run", "1f"}}, columns, 0).flush();
  RunFile::reopen(path, {{"host", "c"}, {"run", "1f"}}, columns, 0).flush();
  const auto origin = Hdf5File::open(path).root().group("provenance");
  CHECK(origin.group("resume_1").read_text("host", 100) == "b");
  CHECK(origin.group("resume_2").read_text("host", 100) == "c");
}

TEST_CASE("A run file that does not fit is refused") {
  const ScratchDirectory directory;
  const auto path = directory / run_file_name;
  const auto error_of_reopening = [&](const std::vector<Column>& series, std::int64_t rows) {
    return message_of<FileError>([&] { RunFile::reopen(path, provenance, series, rows); });
  };
  CHECK(error_of_reopening(columns, 0).find("No such file") != std::string::npos);
  auto file = RunFile::create(path, provenance, columns);
  append_rows(file, 0, 3);
  file.flush();
  CHECK(error_of_reopening(columns, 4).find("has 3 rows of time, but the checkpoint expects 4")
        != std::string::npos);
  CHECK(error_of_reopening({columns[0]}, 3).find("its series are time,velocity instead of time")
        != std::string::npos);
  CHECK(message_of<FileError>([&] {
          RunFile::reopen(path, {{"run", "2f"}}, columns, 3);
        }).find("it belongs to another run")
        != std::string::npos);
  fs::resize_file(path, 500);
  CHECK(error_of_reopening(columns, 3).starts_with(path.string() + ": does not fit"));
}

TEST_CASE("A run does not go on with a file without a seal") {
  const ScratchDirectory directory;
  const auto path = directory / run_file_name;
  RunFile::create(path, provenance, columns).flush();
  overwrite(path, contents(path).substr(seal_size));
  CHECK_FALSE(
      message_of<FileError>([&] { RunFile::reopen(path, provenance, columns, 0); }).empty());
}

TEST_CASE("A run file does not replace another") {
  const ScratchDirectory directory;
  const auto path = directory / run_file_name;
  overwrite(path, "precious");
  CHECK(message_of<FileError>([&] { RunFile::create(path, provenance, columns); })
        == path.string() + ": exists already; choose another directory, or resume that run");
  CHECK(contents(path) == "precious");
}

TEST_CASE("A row of a run file has as many values as there are columns") {
  const ScratchDirectory directory;
  auto file = RunFile::create(directory / run_file_name, provenance, columns);
  CHECK_THROWS_AS(file.append(std::vector{1.0}), std::invalid_argument);
  CHECK_THROWS_AS(file.write_curve(columns, {{1.0, 2.0}, {1.0}}), std::invalid_argument);
}

TEST_CASE("A run file holds the final state in SI units, in the order of the ids") {
  const ScratchDirectory directory;
  const auto path = directory / run_file_name;
  State state;
  state.box = {.width = 0.02, .length = 0.1};
  state.walls = {{.line = 0.0, .radius = 3e-4, .count = 50}};
  state.gravity.y = 10.0;
  state.time_step = 1e-6;
  add_grain(state, {.x = 0.01, .y = 0.03, .vx = 0.5, .vy = -2.0, .radius = 5e-4, .mass = 1e-6});
  add_grain(state, {.x = 0.015, .y = 0.09, .vx = 0.0, .vy = 1.0, .radius = 4e-4, .mass = 2e-6});
  state.contacts = {contact({no_wall, 0, 1}, 0.5)};

  auto file = RunFile::create(path, provenance, {});
  file.write_final_state({}, {});
  const PresentForce force{.x = 0.01, .branch_x = 0.0, .branch_y = 0.0, .fx = 0.25, .fy = -2.0};
  file.write_final_state(reversed(state), {&force, 1});  // replaces
  CHECK_THROWS_AS(file.write_final_state(state, {}), std::invalid_argument);
  file.flush();

  const auto final = Hdf5File::open(path).root().group("final");
  CHECK(final.attribute<std::int64_t>("step") == 0);
  CHECK(final.attribute<double>("time") == 0.0);
  CHECK(final.attribute<double>("box_length") == 0.1);
  CHECK(final.data("position").text_attribute("unit") == "m");
  CHECK(final.data("position").shape().columns == 2);
  const auto position = read<double>(final, "position"), velocity = read<double>(final, "velocity");
  const std::vector expected_position = {0.01, 0.03, 0.015, 0.09};
  const std::vector expected_velocity = {0.5, -2.0, 0.0, 1.0};
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(std::abs(position[i] - expected_position[i]) < 1e-15);
    CHECK(std::abs(velocity[i] - expected_velocity[i]) < 1e-11);
  }
  CHECK(read<double>(final, "radius") == std::vector{5e-4, 4e-4});
  CHECK(read<double>(final, "mass") == std::vector{1e-6, 2e-6});
  CHECK(read<std::int32_t>(final, "id") == std::vector<std::int32_t>{0, 1});
  CHECK(read<double>(final.group("walls"), "spacing") == std::vector{0.1 / 50.0});
  const auto contacts = final.group("contacts");
  CHECK(read<std::int32_t>(contacts, "partner") == std::vector<std::int32_t>{1});
  CHECK(read<double>(contacts, "force") == std::vector{0.25, -2.0});
  CHECK(contacts.data("force").text_attribute("unit") == "N");
  CHECK(contacts.data("force").shape().columns == 2);
}

TEST_CASE("A run file holds the last verdict of validity") {
  const ScratchDirectory directory;
  const auto path = directory / run_file_name;
  auto file = RunFile::create(path, provenance, columns);
  Evidence evidence{.max_overlap_ratio = 0.1,
                    .brake_failure_fraction = std::nan(""),
                    .passages_per_visit = 0.0,
                    .wall_speed_ratio = 0.3,
                    .pulling_fraction = 0.05,
                    .steps_per_contact = 50.0,
                    .energy_error_ratio = 1e-4,
                    .limits_exceeded = 0.0,
                    .contact_rate_times_t_col = 0.01};
  file.write_validity(judge(evidence));
  evidence.max_overlap_ratio = 0.7;
  file.write_validity(judge(evidence));
  file.flush();
  const auto group = Hdf5File::open(path).root().group("validity");
  CHECK(group.text_attribute("verdict") == "unphysical");
  CHECK(group.attribute<double>("max_overlap_ratio") == 0.7);
  CHECK(std::isnan(group.attribute<double>("brake_failure_fraction")));
  CHECK(group.attribute<double>("steps_per_contact") == 50.0);
}

TEST_CASE("A run file holds the last profiles across the tube") {
  const ScratchDirectory directory;
  const auto path = directory / run_file_name;
  auto file = RunFile::create(path, provenance, columns);
  const Strips strips{.width = 1e-3, .length = 0.1, .count = 2};
  TubeProfile profile{.name = "density",
                      .unit = "kg/m^2",
                      .meaning = "Mass per area.",
                      .zones = {{.value = 1.0, .error = 0.1}, {.value = 2.0, .error = 0.2}}};
  file.write_profiles(strips, {profile}, {.since = 0.0, .state = SteadyVerdict::too_short});
  profile.zones[1].error = std::nan("");
  file.write_profiles(strips, {profile}, {.since = 0.25, .state = SteadyVerdict::steady});
  file.flush();
  const auto group = Hdf5File::open(path).root().group("profiles");
  CHECK(group.attribute<double>("since") == 0.25);
  CHECK(group.text_attribute("state") == "steady");
  CHECK(read<double>(group, "x") == std::vector{0.5e-3, 1.5e-3});
  CHECK(read<double>(group, "density") == std::vector{1.0, 2.0});
  CHECK(group.data("density").text_attribute("unit") == "kg/m^2");
  CHECK(group.data("density").text_attribute("doc") == "Mass per area.");
  const auto errors = read<double>(group, "density_error");
  CHECK(errors[0] == 0.1);
  CHECK(std::isnan(errors[1]));
}

TEST_CASE("A run file holds the last histograms, with rates and their errors") {
  const ScratchDirectory directory;
  const auto path = directory / run_file_name;
  auto file = RunFile::create(path, provenance, columns);
  const HistogramTable table{
      .name = "fall_duration",
      .unit = "s",
      .meaning = "How long falls last.",
      .lower_edges = {1.0, 2.0},
      .counts = {3, 40},
      .rates = {{.value = 0.5, .error = 0.1}, {.value = 7.0, .error = std::nan("")}}};
  file.write_histograms({}, {.since = 0.0, .state = SteadyVerdict::too_short});
  file.write_histograms({table},
                        {.since = 0.25, .state = SteadyVerdict::accelerating});  // replaces
  file.flush();
  const auto all = Hdf5File::open(path).root().group("histograms");
  CHECK(all.attribute<double>("since") == 0.25);
  CHECK(all.text_attribute("state") == "accelerating");
  const auto group = all.group("fall_duration");
  CHECK(group.text_attribute("doc") == "How long falls last.");
  CHECK(group.data("lower_edge").text_attribute("unit") == "s");
  CHECK(group.data("rate").text_attribute("unit") == "1/s");
  CHECK(read<double>(group, "lower_edge") == std::vector{1.0, 2.0});
  CHECK(read<std::int64_t>(group, "count") == std::vector<std::int64_t>{3, 40});
  CHECK(read<double>(group, "rate") == std::vector{0.5, 7.0});
  const auto errors = read<double>(group, "rate_error");
  CHECK(errors[0] == 0.1);
  CHECK(std::isnan(errors[1]));
}

TEST_CASE("A run file holds a curve") {
  const ScratchDirectory directory;
  const auto path = directory / run_file_name;
  auto file = RunFile::create(path, provenance, {});
  file.write_curve(columns, {{9.0, 9.0}});
  file.write_curve(columns, {{1.0, 2.0}, {3.0, 4.0}, {5.0, 6.0}});  // replaces
  file.flush();
  const auto curve = Hdf5File::open(path).root().group("curve");
  CHECK(read<double>(curve, "time") == std::vector{1.0, 3.0, 5.0});
  CHECK(read<double>(curve, "velocity") == std::vector{2.0, 4.0, 6.0});
  CHECK(curve.data("velocity").text_attribute("unit") == "m/s");
  CHECK(curve.data("velocity").text_attribute("doc") == "Mean axial velocity.");
}

TEST_CASE("Provenance tells the origin, the build, the machine and the time") {
  setenv("SLURM_JOB_ID", "4711", 1);
  const auto collected =
      collect_provenance({.arguments = {"riesel", "run", "it's a file.yaml", "bad\xff"},
                          .seed = 7,
                          .threads = 3,
                          .source = "source",
                          .settings = "settings",
                          .run = 0x1f});
  unsetenv("SLURM_JOB_ID");
  const std::map<std::string, std::string> values(collected.begin(), collected.end());
  CHECK(values.size() == collected.size());
  CHECK(values.at("command") == "riesel run 'it'\\''s a file.yaml' 'bad?'");
  CHECK(values.at("seed") == "7");
  CHECK(values.at("threads") == "3");
  CHECK(values.at("source") == "source");
  CHECK(values.at("settings") == "settings");
  CHECK(values.at("run") == "000000000000001f");
  CHECK(values.at("slurm_job_id") == "4711");
  CHECK(shape_of(values.at("date")) == "0000-00-00T00:00:00Z");
  for (const auto* name : {"riesel_version", "hdf5_version", "yaml_cpp_version", "eigen_version"}) {
    CHECK(shape_of(values.at(name)).starts_with("0."));
  }
  for (const auto* name : {"git_commit", "git_dirty", "compiler", "build_type", "cpu", "host"}) {
    CHECK_FALSE(values.at(name).empty());
  }
}
