// Any bytes as checkpoint.h5 and as run.h5: read, or refused with a FileError.
//
// The first byte of the input says what the rest is: the content of a file, or changes to that of a
// good one, each a place (2 bytes), what to do there (1 byte) and a word (8 bytes). So a fuzzer needs
// not find out what HDF5 is, and what it finds is short. The length is made right, as who forges a
// file would do; the fuzzer's readers take checksums for right.
#include "engine/simulation.hpp"
#include "engine/tube_profiles.hpp"
#include "io/checkpoint.hpp"
#include "io/file_error.hpp"
#include "io/run_file.hpp"
#include "io/run_reader.hpp"
#include "io/seal.hpp"
#include "io/settings.hpp"
#include "scenarios/scenario.hpp"
#include "tests/fuzz/memory_file.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

using namespace riesel;

namespace {

namespace fs = std::filesystem;
using Content = std::vector<char>;
using Input = std::span<const std::uint8_t>;

const std::vector<io::Column> columns = {{"time", "s", "t"}, {"velocity", "m/s", "v"}};

/// A few grains in a tube, with contacts and visits.
State state_of_a_tube() {
  const auto settings = io::Settings::from_text(
      "scenario: periodic_tube\n"
      "contact: {stiffness: 2000 N/m, restitution: 0.9}\n"
      "grains: {area_fraction: 0.4}\n"
      "tube: {width: 4 mm, length: 5 mm}\n"
      "start: {random_velocity: 2 m/s}\n"
      "run: {duration: 5 ms}\n",
      "tube.yaml", scenarios::settings_tables());
  auto flow = std::get<scenarios::Flow>(scenarios::named(settings.scenario()).prepare(settings));
  Simulation simulation(std::move(flow.state), flow.model, 1);
  do simulation.advance(100);
  while (simulation.state().contacts.size() < 2 || simulation.state().open_visits.empty());
  return simulation.state();
}

/// What `write` puts behind the seal of the file at the path it is given.
Content content_of(const std::function<void(const fs::path&)>& write) {
  auto directory = (fs::temp_directory_path() / "riesel-fuzz-XXXXXX").string();
  if (mkdtemp(directory.data()) == nullptr) std::abort();
  const auto path = fs::path(directory) / "file.h5";
  write(path);
  std::ifstream file(path, std::ios::binary);
  const Content all{std::istreambuf_iterator<char>(file), {}};
  fs::remove_all(directory);
  return {all.begin() + io::seal_size, all.end()};
}

Content good_checkpoint(const State& state) {
  return content_of([&](const fs::path& path) {
    io::write_checkpoint(path, {.state = state,
                                .settings = "scenario: periodic_tube\n",
                                .source = "# mine\n",
                                .rows = 2,
                                .wall_seconds = 0.1,
                                .profiles = TimeBlocks(1, 3, 2, {1.0, 2.0})});
  });
}

Content good_run_file(const State& state) {
  return content_of([&](const fs::path& path) {
    auto file = io::RunFile::create(path, {{"date", "today"}, {"settings", "a: 1"}}, columns);
    for (int i = 0; i < 3; ++i) file.append(std::vector{0.1 * i, -1.0});
    file.write_final_state(state);
    std::vector<TubeProfile> profiles;
    for (const char* name : {"area_fraction", "mean_axial_velocity", "temperature_x",
                             "temperature_y", "stress_xx", "stress_xy", "stress_yy"})
      profiles.push_back({.name = name, .unit = "1", .meaning = "m", .zones = {{}, {}}});
    file.write_profiles({.width = 1e-3, .length = 0.1, .count = 2}, profiles, 0.1);
    file.flush();
  });
}

/// Where the changes go: words that are not zero, as most are unused.
std::vector<std::size_t> words_in_use(const Content& content) {
  constexpr std::size_t word = 8;
  std::vector<std::size_t> places;
  for (std::size_t place = 0; place + word <= content.size(); place += word) {
    const auto begin = content.begin() + static_cast<std::ptrdiff_t>(place);
    if (std::any_of(begin, begin + word, [](char byte) { return byte != 0; }))
      places.push_back(place);
  }
  return places;
}

struct Good {
  explicit Good(Content good) : content(std::move(good)), places(words_in_use(content)) {}
  Content content;
  std::vector<std::size_t> places;
};

std::uint64_t number(Input digits) {
  std::uint64_t value = 0;
  for (std::size_t i = digits.size(); i-- > 0;) value = value << 8U | digits[i];
  return value;
}

std::uint64_t word_of(const Content& content, std::size_t place) {
  std::uint64_t word = 0;
  std::memcpy(&word, &content[place], sizeof word);
  return word;
}

/// Puts the lowest `width` bytes of a number, or fewer at the end.
void put(Content& content, std::size_t place, std::uint64_t value, std::size_t width) {
  for (std::size_t i = 0; i < width && place + i < content.size(); ++i)
    content[place + i] = static_cast<char>(value >> 8U * i);
}

Content changed(const Good& good, Input changes) {
  constexpr std::size_t size = 11;
  enum : unsigned { put_byte, put_half, put_word, copy_word, cut };
  Content content = good.content;
  for (; changes.size() >= size; changes = changes.subspan(size)) {
    const auto place_of = [&](std::uint64_t n) { return good.places[n % good.places.size()]; };
    const std::size_t at = place_of(number(changes.first(2))) + changes[2] / 32U;
    const std::uint64_t value = number(changes.subspan(3, 8));
    switch (changes[2] % 8U) {
    case put_byte:
      put(content, at, value, 1);
      break;
    case put_half:
      put(content, at, value, 4);
      break;
    case put_word:
      put(content, at, value, 8);
      break;
    case copy_word:
      put(content, at, word_of(good.content, place_of(value)), 8);
      break;
    case cut:
      content.resize(std::min<std::size_t>(content.size(), value % good.content.size()));
      break;
    default:
      put(content, at, value, 2);
    }
  }
  return content;
}

/// Behind the first line of a seal.
Content sealed(const Content& content, const std::string& kind) {
  constexpr std::size_t place_of_length = 40;
  const std::string title = "riesel " + kind + "\n";
  Content image(io::seal_size);
  std::copy(title.begin(), title.end(), image.begin());
  image.insert(image.end(), content.begin(), content.end());
  put(image, io::seal_size + place_of_length, image.size(), 8);
  return image;
}

enum class Kind { anything, checkpoint, run };

Kind kind_of(Input input) {
  switch (input.empty() ? 0U : input[0] % 4U) {
  case 1:
    return Kind::checkpoint;
  case 2:
  case 3:
    return Kind::run;
  default:
    return Kind::anything;
  }
}

Content content_from(Input input) {
  static const State state = state_of_a_tube();
  static const Good checkpoint(good_checkpoint(state)), run(good_run_file(state));
  const Input rest = input.subspan(input.empty() ? 0 : 1);
  switch (kind_of(input)) {
  case Kind::checkpoint:
    return changed(checkpoint, rest);
  case Kind::run:
    return changed(run, rest);
  default:
    return {rest.begin(), rest.end()};
  }
}

template <class Read>
void attempt(Read read) {
  try {
    read();
  } catch (const io::FileError&) {
  }
}

}  // namespace

// The name is libFuzzer's.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto content = content_from({data, size});
  const auto kind = kind_of({data, size});
  if (kind != Kind::run) {
    const MemoryFile file(sealed(content, "checkpoint"));
    attempt([&] { io::read_checkpoint(file.path()); });
  }
  if (kind != Kind::checkpoint) {
    const MemoryFile file(sealed(content, io::run_file_kind));
    attempt([&] { io::read_run_file(file.path()); });
    attempt([&] { io::RunFile::reopen(file.path(), {{"date", "later"}}, columns, 2); });
  }
  return 0;
}
