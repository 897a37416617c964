// One process per directory: two runs that write the same files would destroy each other's work.
//
// An flock on the file .lock in the directory. The system drops it when the process ends, however
// it ends, so that no stale lock can stand in the way of a resume. The file stays: removing it
// would let two processes lock two files of the same name.
#pragma once

#include <filesystem>

namespace riesel::io {

/// Holds the lock of a directory as long as it lives.
class DirectoryLock {
public:
  /// Throws FileError if another process holds the lock (naming it), or if the directory cannot be
  /// written.
  explicit DirectoryLock(const std::filesystem::path& directory);
  ~DirectoryLock();

  /// Whether another process works in the directory at the moment. Writes nothing.
  static bool is_held(const std::filesystem::path& directory);

  DirectoryLock(const DirectoryLock&) = delete;
  DirectoryLock& operator=(const DirectoryLock&) = delete;
  DirectoryLock(DirectoryLock&&) = delete;
  DirectoryLock& operator=(DirectoryLock&&) = delete;

private:
  int descriptor_;
};

}  // namespace riesel::io
