// An open file of the system: errors are FileErrors, and it closes itself.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace riesel::io {

/// Errors are reported for `path`, whatever the file is called at the moment. Members throw
/// FileError.
class Descriptor {
public:
  /// `flags` as open(2) wants them.
  Descriptor(const std::filesystem::path& name, int flags, std::filesystem::path path);
  ~Descriptor();
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  Descriptor(Descriptor&&) = delete;
  Descriptor& operator=(Descriptor&&) = delete;

  void write(std::string_view content);
  /// As many bytes as there are, at most `size`.
  std::string read_at(std::uint64_t offset, std::size_t size);
  void write_at(std::uint64_t offset, std::string_view content);

  /// What lies beyond the old end reads as zeros.
  void make_at_least(std::uint64_t size);

  /// On return it is on the disk.
  void sync();

  /// Waits until nobody else has locked the file in this way (flock), and locks it until it is
  /// closed; goes on without a lock where the file system has none, and after ten seconds, as the
  /// other process may be halted.
  void lock() const;

  /// Network file systems report here what could not be written.
  void close();

private:
  void check(ssize_t result, const char* action = "cannot be written") const;

  std::filesystem::path path_;
  int descriptor_;
};

}  // namespace riesel::io
