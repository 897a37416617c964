#include "io/whole_file.hpp"

#include "io/file_error.hpp"
#include "io/uninterrupted.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <span>

namespace riesel::io {
namespace {

namespace fs = std::filesystem;

class File {
public:
  /// O_NONBLOCK, because a plain open() would wait for the writer of a pipe.
  explicit File(const fs::path& path)
      : path_(path),
        descriptor_(
            uninterrupted([&] { return open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK); })) {
    if (descriptor_ < 0) throw system_failure(path_, "cannot be opened", errno);
  }
  ~File() { close(descriptor_); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  File(File&&) = delete;
  File& operator=(File&&) = delete;

  std::uint64_t size() const {
    struct stat about = {};
    if (fstat(descriptor_, &about) != 0) throw system_failure(path_, "cannot be read", errno);
    if (S_ISDIR(about.st_mode)) throw system_failure(path_, "cannot be read", EISDIR);
    if (!S_ISREG(about.st_mode)) throw FileError(path_, "is not a regular file", "check the path");
    return static_cast<std::uint64_t>(about.st_size);
  }

  /// Fills the buffer unless the file ends before. Returns the number of bytes read.
  std::size_t read(std::span<char> buffer) {
    std::size_t size = 0;
    while (size < buffer.size()) {
      const ssize_t got =
          uninterrupted([&] { return ::read(descriptor_, &buffer[size], buffer.size() - size); });
      if (got == 0) break;
      if (got < 0) throw system_failure(path_, "cannot be read", errno);
      size += static_cast<std::size_t>(got);
    }
    return size;
  }

  void go_to(std::uint64_t place) const {
    if (lseek(descriptor_, static_cast<off_t>(place), SEEK_SET) < 0)
      throw system_failure(path_, "cannot be read", errno);
  }

private:
  const fs::path& path_;
  int descriptor_;
};

/// Limits what is read: a sparse file may be longer than any disk.
std::uint64_t memory_of_this_machine() {
  return static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES))
         * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

}  // namespace

std::vector<char> read_whole_file(const fs::path& path, std::uint64_t most) {
  File file(path);
  const auto size = file.size();
  most = std::min(most, memory_of_this_machine());
  if (size > most) {
    throw FileError(path, fmt::format("is larger than {} bytes", most),
                    "check that this is the right file");
  }
  std::vector<char> bytes(size);
  bytes.resize(file.read(bytes));
  return bytes;
}

bool is_bracketed(const fs::path& path) {
  constexpr std::uint64_t most_white_space = 16;  // bytes, at either end
  constexpr auto white_space = " \t\r\n";
  try {
    File file(path);
    const auto size = file.size(), part = std::min(size, most_white_space);
    std::string first(part, '\0'), last(part, '\0');
    first.resize(file.read(first));
    file.go_to(size - part);
    last.resize(file.read(last));
    const auto begin = first.find_first_not_of(white_space);
    const auto end = last.find_last_not_of(white_space);
    return begin != std::string::npos && first[begin] == '{' && end != std::string::npos
           && last[end] == '}';
  } catch (const FileError&) {
    return false;
  }
}

std::string beginning_of(const fs::path& path, std::uint64_t most) {
  try {
    File file(path);
    std::string bytes(std::min(file.size(), most), '\0');
    bytes.resize(file.read(bytes));
    return bytes;
  } catch (const FileError&) {
    return {};
  }
}

}  // namespace riesel::io
