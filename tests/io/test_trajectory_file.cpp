// trajectory.h5: HDF5's own library reads what is written without it, a commit is all or nothing,
// and a run that goes on finds its frames.
#include "io/trajectory_file.hpp"

#include "io/file_error.hpp"
#include "io/hdf5_file.hpp"
#include "tests/io/file_fixture.hpp"

#include <sys/resource.h>

#include <array>
#include <csignal>
#include <numeric>
#include <stdexcept>

using namespace riesel;
using namespace riesel::io;
using namespace file_fixture;

namespace {

constexpr std::uint64_t run = 0x1f;
constexpr std::int64_t steps_per_frame = 10;
constexpr auto settings = "scenario: a\n";

/// Five grains of different sizes, which lie differently in each frame.
State state_of_frame(std::int64_t frame) {
  State state;
  state.box = {.width = 0.02, .length = 0.1};
  state.walls = {{.line = 0.0, .radius = 3.3e-4, .count = 3}};
  state.time_step = 1e-6;
  for (int i = 0; i < 5; ++i)
    add_grain(state, {.x = 1e-3 * i,
                      .y = 1e-3 * static_cast<double>(frame % 97),
                      .vx = 0.1 * i,
                      .vy = 1.0,
                      .radius = 1e-4 * (i + 1),
                      .mass = 1e-6});
  state.step = frame * steps_per_frame;
  return state;
}

TrajectoryFile create(const fs::path& path) {
  return TrajectoryFile::create(path, run, state_of_frame(0), steps_per_frame, settings);
}

void append_frames(TrajectoryFile& file, std::int64_t first, std::int64_t last) {
  for (auto frame = first; frame < last; ++frame) file.append(state_of_frame(frame));
}

/// The steps of all frames, as HDF5 reads them.
std::vector<std::int64_t> steps_of(const fs::path& path) {
  const auto grains = Hdf5File::open(path).root().group("particles").group("grains");
  const auto data = grains.group("position").data("step");
  std::vector<std::int64_t> steps(data.shape().rows);
  data.read(std::span(steps));
  return steps;
}

/// The arrays of a frame begin at multiples of 10 steps.
std::vector<std::int64_t> steps_expected(std::size_t frames) {
  std::vector<std::int64_t> steps(frames);
  for (std::size_t i = 0; i < frames; ++i)
    steps[i] = static_cast<std::int64_t>(i) * steps_per_frame;
  return steps;
}

TrajectoryFile reopen(const fs::path& path, std::int64_t frame) {
  return TrajectoryFile::reopen(path, run, state_of_frame(frame), steps_per_frame, settings);
}

std::string refusal(const fs::path& path, std::int64_t frame) {
  return message_of<FileError>([&] { reopen(path, frame); });
}

}  // namespace

TEST_CASE("a trajectory without frames is a file, too") {
  const ScratchDirectory directory;
  create(directory / "trajectory.h5");
  CHECK(steps_of(directory / "trajectory.h5").empty());
  CHECK(directory.names() == std::vector<std::string>{"trajectory.h5", "trajectory.xdmf2"});
}

TEST_CASE("settings that a trajectory cannot hold are refused, and nothing is written") {
  const ScratchDirectory directory;
  const auto path = directory / "trajectory.h5";
  const std::string longest(65'000, 'x'), longer(70'000, 'x');
  const auto error = message_of<FileError>(
      [&] { TrajectoryFile::create(path, run, state_of_frame(0), steps_per_frame, longer); });
  CHECK(error.starts_with(path.string() + ": cannot hold the settings (700"));
  CHECK(error.ends_with("; shorten them, or run without a trajectory"));
  CHECK(directory.names().empty());
  TrajectoryFile::create(path, run, state_of_frame(0), steps_per_frame, longest);
  CHECK(Hdf5File::open(path).root().group("parameters").text_attribute("settings") == longest);
}

TEST_CASE("frames are there after a commit, however many") {
  const ScratchDirectory directory;
  const auto path = directory / "trajectory.h5";
  auto file = create(path);
  std::int64_t frames = 0;
  // The last are more than 64 blocks of 64 frames: the tree of chunks has two levels.
  for (const std::int64_t next : {1, 2, 63, 64, 65, 700, 4096, 4097, 9000}) {
    append_frames(file, frames, next);
    file.commit();
    CHECK(steps_of(path) == steps_expected(static_cast<std::size_t>(next)));
    frames = next;
  }
}

TEST_CASE("what is not committed cannot be seen, and does no harm") {
  const ScratchDirectory directory;
  const auto path = directory / "trajectory.h5";
  auto file = create(path);
  append_frames(file, 0, 100);
  file.commit();
  append_frames(file, 100, 300);
  CHECK(steps_of(path) == steps_expected(100));
}

TEST_CASE("a commit that fails leaves the frames of the one before, and is the last one") {
  const ScratchDirectory directory;
  const auto path = directory / "trajectory.h5";
  const int status = in_other_process([&] {
    auto file = create(path);
    append_frames(file, 0, 10);
    file.commit();
    append_frames(file, 10, 20);
    const rlimit limit = {.rlim_cur = 1000, .rlim_max = 1000};
    std::signal(SIGXFSZ, SIG_IGN);
    if (setrlimit(RLIMIT_FSIZE, &limit) != 0) return 1;
    const auto error = message_of<FileError>([&] { file.commit(); });
    if (!contains(error, "File too large; raise the limit on the size of files")) return 2;
    const std::string left = contents(path);
    if (message_of<std::logic_error>([&] { file.commit(); }).empty()) return 3;
    return contents(path) == left ? 0 : 4;
  });
  CHECK(status == 0);
  CHECK(steps_of(path) == steps_expected(10));
  auto file = reopen(path, 9);
  append_frames(file, 10, 30);
  file.commit();
  CHECK(steps_of(path) == steps_expected(30));
}

TEST_CASE("arrays that belong to no frame are in the order of the ids") {
  const ScratchDirectory directory;
  const auto path = directory / "trajectory.h5";
  TrajectoryFile::create(path, run, reversed(state_of_frame(0)), steps_per_frame, settings);
  const auto grains = Hdf5File::open(path).root().group("particles").group("grains");
  std::vector<double> radius(5);
  grains.data("radius").read(std::span(radius));
  CHECK(radius == std::vector<double>{1e-4 * 1, 1e-4 * 2, 1e-4 * 3, 1e-4 * 4, 1e-4 * 5});
}

TEST_CASE("a run that goes on keeps the frames up to its step and writes the others anew") {
  const ScratchDirectory directory;
  const auto path = directory / "trajectory.h5";
  {
    auto file = create(path);
    append_frames(file, 0, 200);
    file.commit();
    append_frames(file, 200, 250);
  }
  auto file = reopen(path, 149);
  CHECK(file.frames() == 150);
  CHECK(steps_of(path) == steps_expected(200));  // until the next commit
  file.commit();
  CHECK(steps_of(path) == steps_expected(150));
  append_frames(file, 150, 400);
  file.commit();
  CHECK(steps_of(path) == steps_expected(400));
}

TEST_CASE("outlines leave no more behind than they are long") {
  const ScratchDirectory directory;
  const auto path = directory / "trajectory.h5";
  auto file = create(path);
  for (std::int64_t frame = 0; frame < 3000; ++frame) {
    file.append(state_of_frame(frame));
    if (frame % 10 == 0) file.commit();
  }
  const auto needed = 3000 * size_of_frame(state_of_frame(0)).file;
  CHECK(fs::file_size(path) < needed + needed / 2 + 300'000);
}

TEST_CASE("a trajectory that does not fit the checkpoint is refused") {
  const ScratchDirectory directory;
  const auto path = directory / "trajectory.h5";
  auto file = create(path);
  append_frames(file, 0, 20);
  file.commit();
  CHECK(refusal(path, 19).empty());
  CHECK(refusal(path, 20).find("has 20 frames, but the checkpoint expects 21")
        != std::string::npos);
  CHECK(refusal(directory / "none.h5", 3).find("is missing") != std::string::npos);

  CHECK(message_of<FileError>([&] {
          TrajectoryFile::reopen(path, run + 1, state_of_frame(3), steps_per_frame, settings);
        }).find("it belongs to another run")
        != std::string::npos);
  State other = state_of_frame(3);
  add_grain(other, {.x = 0.01, .y = 0.0, .vx = 0.0, .vy = 0.0, .radius = 1e-3, .mass = 1e-6});
  CHECK_THROWS_AS(TrajectoryFile::reopen(path, run, other, steps_per_frame, settings), FileError);
  CHECK_THROWS_AS(TrajectoryFile::reopen(path, run, state_of_frame(3), 7, settings), FileError);
  CHECK_THROWS_AS(create(path), FileError);
}

TEST_CASE("a damaged trajectory is refused") {
  const ScratchDirectory directory;
  const auto path = directory / "trajectory.h5";
  {
    auto file = create(path);
    append_frames(file, 0, 20);
    file.commit();
  }
  const std::string whole = contents(path);
  constexpr std::size_t head = 512;
  for (std::size_t byte = 0; byte < head; ++byte) {
    std::string damaged = whole;
    damaged[byte] ^= 1;
    overwrite(path, damaged);
    REQUIRE(refusal(path, 3).find("does not fit the checkpoint") != std::string::npos);
  }
  for (const std::size_t size : {std::size_t{0}, head / 2, head, whole.size() / 4}) {
    overwrite(path, whole.substr(0, size));
    CHECK(refusal(path, 3).find("does not fit the checkpoint") != std::string::npos);
  }
  // The outline in use stands behind the blocks, and begins with their addresses.
  std::string damaged = whole;
  const auto outline = damaged.rfind("TREE");
  damaged[outline] ^= 1;
  overwrite(path, damaged);
  CHECK(refusal(path, 3).find("outline is damaged") != std::string::npos);
  overwrite(path, whole);
  CHECK(refusal(path, 3).empty());
}
