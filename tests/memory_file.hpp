// A file without a disk, for readers that want a path.
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>

namespace riesel {

class MemoryFile {
public:
  explicit MemoryFile(std::span<const char> bytes)
      : descriptor_(memfd_create("fuzz", MFD_CLOEXEC)) {
    const auto size = static_cast<ssize_t>(bytes.size());
    if (descriptor_ < 0 || write(descriptor_, bytes.data(), bytes.size()) != size)
      throw std::runtime_error("there is no memory for the file");
  }
  ~MemoryFile() { close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  MemoryFile(MemoryFile&&) = delete;
  MemoryFile& operator=(MemoryFile&&) = delete;

  void put(std::size_t place, char byte) const {
    if (pwrite(descriptor_, &byte, 1, static_cast<off_t>(place)) != 1)
      throw std::runtime_error("the file in memory cannot be changed");
  }

  void cut(std::size_t size) const {
    if (ftruncate(descriptor_, static_cast<off_t>(size)) != 0)
      throw std::runtime_error("the file in memory cannot be cut");
  }

  std::filesystem::path path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

private:
  int descriptor_;
};

}  // namespace riesel
