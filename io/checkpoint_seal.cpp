#include "io/checkpoint_seal.hpp"

#include "engine/hash.hpp"
#include "io/file_error.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <string_view>
#include <vector>

namespace riesel::io {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kind = "riesel checkpoint\n";
constexpr std::size_t block_size = 65536;  // bytes read at once

/// The seal of a file of `size` bytes, itself included.
std::string seal_text(std::uint64_t size, const Hash& checksum) {
  auto text = fmt::format("{}An HDF5 file behind a block of {} bytes\n"
                          "bytes in all: {}\n"
                          "FNV-1a of those behind the block: {:016x}\n",
                          kind, seal_size, size, checksum.value());
  text.resize(seal_size, '\0');
  return text;
}

/// A file read from its beginning to its end.
class Reader {
public:
  explicit Reader(const fs::path& path)
      : path_(path), descriptor_(open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
    if (descriptor_ < 0) throw system_failure(path_, "cannot be opened", errno);
  }
  ~Reader() { close(descriptor_); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  Reader(Reader&&) = delete;
  Reader& operator=(Reader&&) = delete;

  /// The next bytes, as many as fit into the buffer; fewer at the end of the file only.
  std::span<const char> read(std::span<char> buffer) {
    std::size_t size = 0;
    while (size < buffer.size()) {
      const ssize_t got = ::read(descriptor_, &buffer[size], buffer.size() - size);
      if (got == 0) break;
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) throw system_failure(path_, "cannot be read", errno);
      size += static_cast<std::size_t>(got);
    }
    return buffer.first(size);
  }

private:
  const fs::path& path_;
  int descriptor_;
};

}  // namespace

void seal(std::span<char> image) {
  Hash checksum;
  for (const char byte : image.subspan(seal_size)) checksum.add(byte);
  seal_text(image.size(), checksum).copy(image.data(), seal_size);
}

std::string flaw_of_seal(const fs::path& path) {
  Reader file(path);
  std::vector<char> buffer(block_size);
  const auto head = file.read(std::span(buffer).first(seal_size));
  const std::string found(head.begin(), head.end());
  if (!found.starts_with(kind)) return "it does not begin like a checkpoint of riesel";
  Hash checksum;
  std::uint64_t size = found.size();
  for (auto block = file.read(buffer); !block.empty(); block = file.read(buffer)) {
    for (const char byte : block) checksum.add(byte);
    size += block.size();
  }
  return found == seal_text(size, checksum) ? "" : "its length or checksum is wrong";
}

}  // namespace riesel::io
