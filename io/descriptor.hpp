// An open file descriptor that closes itself and reports errors as FileError.
#pragma once

#include <sys/stat.h>
#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace riesel::io {

/// Errors name `path`, whatever the file is called at the moment. Members throw FileError.
class Descriptor {
public:
  /// `flags` as for open(2).
  Descriptor(const std::filesystem::path& name, int flags, std::filesystem::path path);
  ~Descriptor();
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  Descriptor(Descriptor&&) = delete;
  Descriptor& operator=(Descriptor&&) = delete;

  void write(std::string_view content);
  /// The bytes from `offset` on: `size` of them, or fewer if the file ends before.
  std::string read_at(std::uint64_t offset, std::size_t size);
  void write_at(std::uint64_t offset, std::string_view content);

  std::uint64_t size() const;  ///< bytes
  /// Whether the file can also be reached by another name (a hard link).
  bool has_other_names() const;

  /// Extends the file if it is shorter; what lies beyond the old end reads as zeros.
  void make_at_least(std::uint64_t wanted);

  /// On return the content is on the disk.
  void sync();

  /// Waits until no other process holds the lock of this file (flock), then holds it until the file
  /// is closed. Goes on without a lock where the file system has none, and after ten seconds, as
  /// the other process may be suspended.
  void lock() const;

  /// Network file systems may report only here what could not be written.
  void close();

private:
  struct stat status() const;
  void check(ssize_t result, const char* action = "cannot be written") const;

  std::filesystem::path path_;
  int descriptor_;
};

}  // namespace riesel::io
