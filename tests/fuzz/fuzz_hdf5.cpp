// Any bytes as checkpoint.h5, run.h5 and trajectory.h5: read, or refused with a FileError.
//
// The first byte of the input says what the rest is: the content of a file, or changes to that of a
// good one, each a place (2 bytes), what to do there (1 byte) and a word (8 bytes). So a fuzzer
// needs not find out what HDF5 is, and what it finds is short. The length is made right, as who
// forges a file would do; the fuzzer's readers take the checksums of data sets for right.
#include "io/checkpoint.hpp"
#include "io/run_file.hpp"
#include "io/run_reader.hpp"
#include "io/seal.hpp"
#include "tests/fuzz/attempt.hpp"
#include "tests/memory_file.hpp"
#include "tests/scratch_directory.hpp"
#include "tests/small_files.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

using namespace riesel;
using fuzz::attempt;

namespace {

namespace fs = std::filesystem;
using Content = std::vector<char>;
using Input = std::span<const std::uint8_t>;

/// What stands behind the seal.
Content content_of(void (*write)(const fs::path&)) {
  const auto all = small_file(write);
  return {all.begin() + io::seal_size, all.end()};
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

/// Behind a seal. The length that HDF5 wants is made right, too.
Content sealed(const Content& content, const std::string& kind) {
  constexpr std::size_t place_of_length = 40;
  Content image(io::seal_size + content.size());
  std::copy(content.begin(), content.end(), image.begin() + io::seal_size);
  put(image, io::seal_size + place_of_length, image.size(), 8);
  io::seal(image, kind);
  return image;
}

enum class Kind { anything, checkpoint, run, trajectory };

Kind kind_of(Input input) {
  switch (input.empty() ? 0U : input[0] % 8U) {
  case 1:
  case 5:
    return Kind::checkpoint;
  case 2:
  case 3:
  case 6:
  case 7:
    return Kind::run;
  case 4:
    return Kind::trajectory;
  default:
    return Kind::anything;
  }
}

Content content_from(Input input) {
  static const Good checkpoint(content_of(write_small_checkpoint)),
      run(content_of(write_small_run_file)), trajectory(small_file(write_small_trajectory));
  const Input rest = input.subspan(input.empty() ? 0 : 1);
  switch (kind_of(input)) {
  case Kind::checkpoint:
    return changed(checkpoint, rest);
  case Kind::run:
    return changed(run, rest);
  case Kind::trajectory:
    return changed(trajectory, rest);
  default:
    return {rest.begin(), rest.end()};
  }
}

/// It is opened to be written, which files in memory refuse by their names.
void go_on_with_trajectory(const Content& content) {
  static const ScratchDirectory directory;
  static const auto path = directory / "trajectory.h5";
  std::ofstream(path, std::ios::binary)
      .write(content.data(), static_cast<std::streamsize>(content.size()));
  attempt("trajectory", [&] { reopen_small_trajectory(path); });
}

}  // namespace

// The name is libFuzzer's. NOLINTNEXTLINE(readability-identifier-naming)
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto content = content_from({data, size});
  const auto kind = kind_of({data, size});
  if (kind == Kind::trajectory || kind == Kind::anything) go_on_with_trajectory(content);
  if (kind == Kind::checkpoint || kind == Kind::anything) {
    const MemoryFile file(sealed(content, "checkpoint"));
    attempt("checkpoint", [&] { io::read_checkpoint(file.path()); });
  }
  if (kind == Kind::run || kind == Kind::anything) {
    const MemoryFile file(sealed(content, io::run_file_kind));
    attempt("run", [&] { io::read_run_file(file.path()); });
    attempt("resume", [&] {
      io::RunFile::reopen(file.path(), {{"date", "later"}, {"run", "1f"}}, small_columns, 2);
    });
  }
  return 0;
}
