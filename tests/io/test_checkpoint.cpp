// Checkpoints: the same bits come back, and nothing else ever does.
#include "io/checkpoint.hpp"
#include "io/durable_file.hpp"
#include "io/file_error.hpp"
#include "io/hdf5_file.hpp"
#include "io/seal.hpp"
#include "io/state_layout.hpp"
#include "tests/bits.hpp"
#include "tests/io/file_fixture.hpp"

#include <functional>
#include <random>
#include <utility>

using namespace riesel;
using namespace riesel::io;
using namespace file_fixture;

namespace {

Checkpoint special_checkpoint(std::size_t grains = 4, double inertia = 0.0) {
  return {.state = special_state(grains, inertia),
          .settings = "scenario: periodic_tube\ntitle: \"Rüttelsieb\"\n",
          .source = "# mine\nscenario: periodic_tube\n",
          .run = 0xfedcba9876543210U,
          .warnings = {"limits.speed is exceeded", "limits.overlap is exceeded"},
          .rows = 5,
          .wall_seconds = 0.1,
          .profiles = TimeBlocks(3, 5, 2, {1.0 / 3.0, -0.0, 1e300, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0}),
          .histograms = TimeBlocks(2, 5, 4, {11.0, 0.0, 12.0, 13.0})};
}

std::string bits_of(const Checkpoint& checkpoint) {
  Bits bits;
  bits.add(checkpoint.run);
  bits.add(checkpoint.rows);
  bits.add(checkpoint.wall_seconds);
  for (const TimeBlocks* blocks : {&checkpoint.profiles, &checkpoint.histograms}) {
    bits.add(blocks->columns());
    bits.add(blocks->samples());
    bits.add(blocks->samples_per_block());
    bits.add_all(blocks->sums());
  }
  auto all = riesel::bits_of(checkpoint.state) + bits.value() + checkpoint.settings + '\n'
             + checkpoint.source;
  for (const auto& warning : checkpoint.warnings) all += '\n' + warning;
  return all;
}

std::string error_of_reading(const fs::path& path) {
  return message_of<FileError>([&] { read_checkpoint(path); });
}

/// Why a changed checkpoint is not written; no file is left of it.
std::string refusal(const std::function<void(Checkpoint&)>& change) {
  const ScratchDirectory directory;
  auto checkpoint = special_checkpoint();
  change(checkpoint);
  const auto error =
      message_of<FileError>([&] { write_checkpoint(directory / "c.h5", checkpoint); });
  CHECK(directory.names().empty());
  const auto begin = error.find('('), end = error.rfind(");");
  return begin == std::string::npos ? error : error.substr(begin + 1, end - begin - 1);
}

/// Replaces a good checkpoint by a copy that is changed and sealed, as only a wrong program would.
void forge(const fs::path& path, const std::function<void(Hdf5Group&)>& change) {
  auto file = Hdf5File::create(seal_size);
  {
    const auto old = Hdf5File::open(path).root();
    auto root = file.root();
    for (const auto* name : {"grains", "walls", "contacts", "open_visits", "tally", "profiles",
                             "histograms", "settings", "source", "warnings", "deepest_contacts"}) {
      root.copy(old, name);
    }
    const auto copy_attribute = [&](const char* name, auto value) {
      root.set_attribute(name, old.attribute<decltype(value)>(name));
    };
    const State state;
    for_each_scalar(state, copy_attribute);
    copy_attribute("format_version", std::int64_t{});
    copy_attribute("run", std::uint64_t{});
    copy_attribute("rows", std::int64_t{});
    copy_attribute("wall_seconds", double{});
    change(root);
  }
  const auto image = file.image();
  seal(image, "checkpoint");
  overwrite(path, {image.begin(), image.end()});
}

}  // namespace

TEST_CASE("A checkpoint comes back bit by bit") {
  const ScratchDirectory directory;
  const auto n = GENERATE(4U, 70'001U);  // more than fit into one chunk
  const auto checkpoint = special_checkpoint(n);
  write_checkpoint(directory / "c.h5", checkpoint);
  CHECK((bits_of(read_checkpoint(directory / "c.h5")) == bits_of(checkpoint)));
}

TEST_CASE("A checkpoint of a grain at a smooth wall without contacts and texts comes back") {
  const ScratchDirectory directory;
  Checkpoint checkpoint;
  checkpoint.state.box = {.width = 1.0, .length = 1.0};
  checkpoint.state.time_step = 1.0;
  checkpoint.state.walls = {WallLattice::smooth_at(0.0)};
  add_grain(checkpoint.state,
            {.x = 0.5, .y = 0.5, .vx = 0.0, .vy = 0.0, .radius = 0.1, .mass = 1.0});
  write_checkpoint(directory / "c.h5", checkpoint);
  CHECK((bits_of(read_checkpoint(directory / "c.h5")) == bits_of(checkpoint)));
}

TEST_CASE("Equal checkpoints are equal files, for any order of the grains in memory") {
  const ScratchDirectory directory;
  auto checkpoint = special_checkpoint();
  write_checkpoint(directory / "a.h5", checkpoint);
  checkpoint.state = reversed(checkpoint.state);
  write_checkpoint(directory / "b.h5", checkpoint);
  write_checkpoint(directory / "c.h5", read_checkpoint(directory / "a.h5"));
  CHECK((contents(directory / "a.h5") == contents(directory / "b.h5")));
  CHECK((contents(directory / "a.h5") == contents(directory / "c.h5")));
}

TEST_CASE("A checkpoint with texts of many kilobytes comes back") {
  const ScratchDirectory directory;
  auto checkpoint = special_checkpoint();
  checkpoint.source = std::string(500'000, 'x') + "end";
  write_checkpoint(directory / "c.h5", checkpoint);
  CHECK((read_checkpoint(directory / "c.h5").source == checkpoint.source));
}

TEST_CASE("Each byte of a checkpoint is protected") {
  // All of the seal, and samples of what it seals, which is all treated alike. (Every length and
  // one bit of every byte were tried once; that takes minutes.)
  const ScratchDirectory directory;
  const auto path = directory / "c.h5";
  write_checkpoint(path, special_checkpoint());
  const auto bytes = contents(path);
  const auto is_tried = [](std::size_t place) { return place < seal_size || place % 31 == 0; };

  SECTION("truncations") {
    for (std::size_t size = bytes.size(); size-- > 0;) {
      if (!is_tried(size)) continue;
      fs::resize_file(path, size);
      REQUIRE_FALSE(error_of_reading(path).empty());
    }
  }
  SECTION("flipped bits") {
    std::mt19937 random(1);
    std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
    const auto put = [&](std::size_t place, char byte) {
      file.seekp(static_cast<std::streamoff>(place));
      file.put(byte).flush();
    };
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      if (!is_tried(i)) continue;
      put(i, static_cast<char>(bytes[i] ^ (1 << random() % 8)));
      REQUIRE_FALSE(error_of_reading(path).empty());
      put(i, bytes[i]);
    }
    CHECK(error_of_reading(path).empty());
  }
  SECTION("additions") {
    overwrite(path, bytes + '\0');
    CHECK_FALSE(error_of_reading(path).empty());
  }
}

TEST_CASE("Checkpoints of riesel 0.10, whose seals lack a line, are read") {
  const ScratchDirectory directory;
  const auto path = directory / "c.h5";
  write_checkpoint(path, special_checkpoint());
  auto bytes = contents(path);
  const auto begin = bytes.find("CRC-32"), end = bytes.find('\n', begin) + 1;
  REQUIRE(end < seal_size);
  std::fill(bytes.begin() + static_cast<std::ptrdiff_t>(begin),
            bytes.begin() + static_cast<std::ptrdiff_t>(end), '\0');
  overwrite(path, bytes);
  CHECK(error_of_reading(path).empty());
}

TEST_CASE("Behind the seal, data sets have checksums for any reader of HDF5") {
  const ScratchDirectory directory;
  const auto path = directory / "c.h5";
  const auto checkpoint = special_checkpoint();
  write_checkpoint(path, checkpoint);
  auto bytes = contents(path);
  std::vector<riesel::Fixed> x;
  for (const auto& at : checkpoint.state.grains.position) x.push_back(at.x);
  const auto place = bytes.find({reinterpret_cast<const char*>(x.data()), x.size() * sizeof x[0]});
  REQUIRE(place != std::string::npos);
  bytes[place] = static_cast<char>(bytes[place] ^ 1);
  seal(bytes, "checkpoint");
  overwrite(path, bytes);
  const auto error = error_of_reading(path);
  CAPTURE(error);
  CHECK(error.find("is damaged (cannot read the data set /grains/x") != std::string::npos);
  CHECK(error.ends_with("start the run again"));
}

TEST_CASE("Files that are no checkpoint are refused") {
  const ScratchDirectory directory;
  const auto path = directory / "c.h5";
  CHECK(error_of_reading(path)
        == path.string() + ": cannot be opened: No such file or directory; check the path");
  overwrite(path, "");
  CHECK(error_of_reading(path)
        == path.string()
               + ": is damaged (it does not begin like a checkpoint of riesel); start the run "
                 "again");
  CHECK_FALSE(error_of_reading(directory.path()).empty());
}

TEST_CASE("A forged checkpoint that is not changed is good") {  // for the sake of the next tests
  const ScratchDirectory directory;
  const auto path = directory / "c.h5";
  write_checkpoint(path, special_checkpoint());
  forge(path, [](Hdf5Group&) {});
  CHECK((bits_of(read_checkpoint(path)) == bits_of(special_checkpoint())));
}

TEST_CASE("A checkpoint of another version of the format is refused with the way out") {
  const ScratchDirectory directory;
  const auto path = directory / "c.h5";
  write_checkpoint(path, special_checkpoint());
  write_checkpoint(path, special_checkpoint());
  for (const fs::path& generation : {path, previous_generation(path)})
    forge(generation, [](Hdf5Group& root) {
      root.set_attribute("format_version", std::int64_t{99});
      root.set_attribute("riesel_version", "9.9.9");
    });
  for (const auto& error :
       {error_of_reading(path), message_of<FileError>([&] { find_checkpoint(path); })}) {
    CAPTURE(error);
    CHECK(error.find("has format version 99, but this riesel (") != std::string::npos);
    CHECK(error.ends_with("; use riesel 9.9.9"));
  }
}

TEST_CASE("A checkpoint of grains that rotate holds all bits of their spins") {
  const ScratchDirectory directory;
  const auto path = directory / "c.h5";
  auto checkpoint = special_checkpoint(5, 0.4);
  write_checkpoint(path, checkpoint);
  CHECK((bits_of(read_checkpoint(path)) == bits_of(checkpoint)));
  checkpoint.state = reversed(checkpoint.state);
  write_checkpoint(directory / "d.h5", checkpoint);
  CHECK((contents(directory / "d.h5") == contents(path)));
}

TEST_CASE("A checkpoint of a wrong shape is refused") {
  const ScratchDirectory directory;
  const auto path = directory / "c.h5";
  write_checkpoint(path, special_checkpoint());
  const std::function<void(Hdf5Group&)> change = GENERATE(values<std::function<void(Hdf5Group&)>>(
      {[](Hdf5Group& root) { root.remove("grains"); },
       [](Hdf5Group& root) { root.group("grains").remove("kick_x"); },
       [](Hdf5Group& root) {
         root.group("grains").remove("x");
         root.group("grains").create_data<std::int64_t>("x", {.rows = 3});
       },
       [](Hdf5Group& root) {
         root.group("grains").remove("x");
         root.group("grains").create_data<double>("x", {.rows = 4});
       },
       [](Hdf5Group& root) {
         root.group("grains").remove("x");
         root.group("grains").create_data<std::int64_t>("x", {.rows = 2, .columns = 2});
       },
       [](Hdf5Group& root) {
         root.group("grains").remove("x");
         root.group("grains").create_data<std::int64_t>("x", {.rows = std::size_t{1} << 40});
       },
       [](Hdf5Group& root) {
         root.group("contacts").remove("end");
         root.group("contacts").create_data<double>("end", {.rows = 3});
       },
       [](Hdf5Group& root) {
         root.group("open_visits").remove("impulse_x");
         root.group("open_visits")
             .create_data<std::int64_t>("impulse_x", {.rows = 3, .columns = 3});
       },
       [](Hdf5Group& root) { root.remove("profiles"); },
       [](Hdf5Group& root) { root.remove("histograms"); },
       [](Hdf5Group& root) { root.group("profiles").set_attribute("samples", std::int64_t{7}); },
       [](Hdf5Group& root) { root.group("profiles").set_attribute("columns", std::int64_t{-3}); },
       [](Hdf5Group& root) { root.set_attribute("step", -1.5); },
       [](Hdf5Group& root) { root.set_attribute("step", std::int64_t{-1}); },
       [](Hdf5Group& root) { root.set_attribute("rows", "many"); },
       [](Hdf5Group& root) { root.set_attribute("format_version", "one"); },
       [](Hdf5Group& root) {
         root.remove("settings");
         root.create_data<double>("settings", {.rows = 1});
       }}));
  forge(path, change);
  const auto error = error_of_reading(path);
  CAPTURE(error);
  CHECK(error.starts_with(path.string() + ": is damaged ("));
  CHECK(error.find('\n') == std::string::npos);
}

TEST_CASE("What no run can go on from does not replace a checkpoint") {
  constexpr auto nan = std::numeric_limits<double>::quiet_NaN();
  constexpr auto infinity = std::numeric_limits<double>::infinity();
  CHECK(refusal([](auto& c) { c.state.box.width = 0.0; })
        == "the width of the box is not positive");
  CHECK(refusal([](auto& c) { c.state.box.length = infinity; })
        == "the length of the box is not positive");
  CHECK(refusal([](auto& c) { c.state.time_step = -1.0; }) == "the time step is not positive");
  CHECK(refusal([](auto& c) { c.state.gravity.y = nan; }) == "gravity is not finite");
  CHECK(refusal([](auto& c) { c.state.gravity.x = nan; }) == "gravity is not finite");
  CHECK(refusal([](auto& c) { c.state.origin.energy = nan; })
        == "the energy, momentum or moment at the start is not finite");
  CHECK(refusal([](auto& c) { c.state.step = -1; }) == "the number of steps is negative");
  CHECK(refusal([](auto& c) { c.state.step = INT64_MAX - 1; }) == "the number of steps is absurd");
  CHECK(refusal([](auto& c) { c.state.walls.clear(); }) == "there are no walls");
  CHECK(refusal([](auto& c) { c.state.walls.resize(3); }) == "there are 3 walls");
  CHECK(refusal([](auto& c) { c.state.walls[0].line = nan; })
        == "the line of wall 0 is not finite");
  CHECK(refusal([](auto& c) { std::swap(c.state.walls[0].line, c.state.walls[1].line); })
        == "wall 1 is to the left of the one before");
  CHECK(refusal([](auto& c) { c.state.walls[0].radius = 0.0; })
        == "wall 0 has 83 grains of radius 0");
  CHECK(refusal([](auto& c) { c.state.walls[0].count = 0; })
        == "wall 0 has 0 grains of radius 0.00033");
  CHECK(refusal([](auto& c) { c.state.walls[1].motion.velocity = 1e300; })
        == "wall 1 moves too far or too fast");
  CHECK(refusal([](auto& c) { c.state.walls[1].motion.frequency = nan; })
        == "wall 1 moves too far or too fast");
  CHECK(refusal([](auto& c) { c.state.walls[1].motion.phase = nan; })
        == "wall 1 moves too far or too fast");
  CHECK(refusal([](auto& c) { c.state.walls[1].motion.amplitude_x = 1.0; })
        == "wall 1 moves too far or too fast");
  CHECK(refusal([](auto& c) { c.state.grains.resize(0); }) == "there are no grains");
  CHECK(refusal([](auto& c) { c.state.grains.radius[1] = nan; })
        == "the radius of grain 1 is not positive");
  CHECK(refusal([](auto& c) { c.state.grains.mass[2] = -1.0; })
        == "the mass of grain 2 is not positive");
  CHECK(refusal([](auto& c) { c.state.grains.id[2] = 1; }) == "two grains have the id 1");
  CHECK(refusal([](auto& c) { c.state.grains.id[2] = 4; }) == "the id 4 is out of range");
  CHECK(refusal([](auto& c) { c.state.grains.kick.pop_back(); })
        == "not all grains have all values");
  CHECK(refusal([](auto& c) { c.state.grains.spin.push_back(1); })
        == "not all grains have all values");
  CHECK(refusal([](auto& c) { c.state.grains.inertia = 0.5; }) == "not all grains have all values");
  CHECK(refusal([](auto& c) { c.state.grains.inertia = -0.5; })
        == "the moment of inertia is negative");
  CHECK(refusal([](auto& c) { std::swap(c.state.contacts[0], c.state.contacts[1]); })
        == "the contact (wall -1, grain 0, partner 3) is out of order");
  CHECK(refusal([](auto& c) { c.state.contacts[1] = c.state.contacts[0]; })
        == "the contact (wall -1, grain 0, partner 3) is out of order");
  CHECK(refusal([](auto& c) { c.state.contacts[1].name.partner = 4; })
        == "the contact (wall -1, grain 1, partner 4) is between bodies that do not exist");
  CHECK(refusal([](auto& c) { c.state.contacts[1].name.partner = 1; })
        == "the contact (wall -1, grain 1, partner 1) is between bodies that do not exist");
  CHECK(refusal([](auto& c) { c.state.contacts[2].name.partner = 83; })
        == "the contact (wall 0, grain 0, partner 83) is between bodies that do not exist");
  CHECK(refusal([](auto& c) { c.state.contacts[3].name.wall = 2; })
        == "the contact (wall 2, grain 2, partner 0) is between bodies that do not exist");
  CHECK(refusal([](auto& c) { c.state.contacts[0].slip_path = nan; })
        == "the contact (wall -1, grain 0, partner 3) has a value that is not finite");
  CHECK(refusal([](auto& c) { c.state.contacts[0].slip_path = infinity; })
        == "the contact (wall -1, grain 0, partner 3) has a value that is not finite");
  CHECK(refusal([](auto& c) { c.state.tally.walls.begun = -1; })
        == "a count of contacts is negative");
  CHECK(
      refusal([](auto& c) { c.state.tally.walls.begun = std::numeric_limits<std::int64_t>::max(); })
      == "a count of contacts is absurd");
  CHECK(refusal([](auto& c) { c.state.tally.grains.max_overlap = nan; })
        == "the greatest overlap is not finite");
  CHECK(refusal([](auto& c) { c.state.tally.walls.deepest.reset(); })
        == "nobody had the greatest overlap");
  CHECK(refusal([](auto& c) { std::swap(c.state.open_visits[0], c.state.open_visits[1]); })
        == "the visit of grain 0 to wall 0 is out of order");
  CHECK(refusal([](auto& c) { c.state.open_visits[2].grain = 4; })
        == "the visit of grain 4 to wall 1 is between bodies that do not exist");
  CHECK(refusal([](auto& c) { c.state.open_visits[0].wall = no_wall; })
        == "the visit of grain 0 to wall -1 is between bodies that do not exist");
  CHECK(refusal([](auto& c) { c.state.open_visits[2].span.end = nan; })
        == "the visit of grain 3 to wall 1 has a value that is not finite");
  CHECK(refusal([](auto& c) { c.state.open_visits[1].contacts = 0; })
        == "the visit of grain 0 to wall 0 has no contacts");
  CHECK(refusal([](auto& c) { c.state.tally.brakes.cut_short = -1; })
        == "a count of contacts with walls is negative");
  CHECK(refusal([](auto& c) { c.state.tally.visits.of_contacts[7] = -1; })
        == "a count of contacts with walls is negative");
  CHECK(refusal([](auto& c) { c.rows = -1; }) == "the number of rows is negative");
  CHECK(refusal([](auto& c) { c.wall_seconds = nan; })
        == "the wall-clock time is negative or not finite");
  CHECK(refusal([](auto& c) { c.profiles = TimeBlocks(1, 1, 1, {infinity}); })
        == "a sum over a block of time is not finite");
  CHECK(refusal([](auto& c) { c.histograms = TimeBlocks(1, 1, 1, {infinity}); })
        == "a sum over a block of time is not finite");
  CHECK(refusal([](auto& c) { c.rows = 4; })
        == "the profiles have 5 samples, but there are 4 rows");
  CHECK(refusal([](auto& c) { c.histograms = TimeBlocks(1, 6, 8, {1.0}); })
        == "the histograms have 6 samples, but there are 5 rows");
}

TEST_CASE("A newer checkpoint of another version is not passed over for an older one") {
  const ScratchDirectory directory;
  const auto path = directory / "c.h5";
  write_checkpoint(path, special_checkpoint());
  write_checkpoint(path, special_checkpoint());
  forge(path, [](Hdf5Group& root) {
    root.set_attribute("format_version", std::int64_t{99});
    root.set_attribute("riesel_version", "9.9.9");
  });
  const auto error = message_of<FileError>([&] { find_checkpoint(path); });
  CAPTURE(error);
  CHECK(error.find("has format version 99") != std::string::npos);
}

TEST_CASE("The newest good generation of a checkpoint is found") {
  const ScratchDirectory directory;
  const auto path = directory / checkpoint_name;
  auto checkpoint = special_checkpoint();
  for (const double seconds : {1.0, 2.0}) {
    checkpoint.wall_seconds = seconds;
    write_checkpoint(path, checkpoint);
  }
  const auto from = GENERATE(true, false) ? directory.path() : path;

  SECTION("the newest") {
    const auto found = find_checkpoint(from);
    CHECK(found.checkpoint.wall_seconds == 2);
    CHECK(found.path == path);
    CHECK(found.note.empty());
  }
  SECTION("the one before, as the newest is damaged") {
    fs::resize_file(path, 1000);
    CHECK(error_of_reading(path).ends_with("; use " + previous_generation(path).string()));
    const auto found = find_checkpoint(from);
    CHECK(found.checkpoint.wall_seconds == 1);
    CHECK(found.path == previous_generation(path));
    CHECK(found.note == path.string() + ": is damaged (its length or checksum is wrong)");
  }
  SECTION("the one before, as the newest is missing") {
    fs::remove(path);
    const auto found = find_checkpoint(from);
    CHECK(found.checkpoint.wall_seconds == 1);
    CHECK(found.note == path.string() + ": cannot be opened: No such file or directory");
  }
  SECTION("none") {
    fs::resize_file(path, 1000);
    fs::resize_file(previous_generation(path), 1000);
    const auto error = message_of<FileError>([&] { find_checkpoint(from); });
    CAPTURE(error);
    CHECK(error.find("checkpoint.h5: is damaged") != std::string::npos);
    CHECK(error.find("checkpoint.h5.previous: is damaged") != std::string::npos);
    CHECK(error.ends_with("; start the run again"));
  }
}
