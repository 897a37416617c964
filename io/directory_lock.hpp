// One process per directory: two runs that write the same files would destroy each other's work.
//
// An flock on the file .lock in the directory. The system drops it when the process ends, however
// it ends, so that no stale lock can stand in the way of a resume. The file stays: removing it
// would let two processes lock two files of the same name.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace riesel::io {

/// Which file it is, whatever its name: equal for no two of them.
struct FileIdentity {
  std::uint64_t device = 0, inode = 0;
  bool operator==(const FileIdentity&) const = default;
};

/// Whether the holder of a lock is written into it at once, or when sign() is called: whoever may
/// still find that there is nothing to do changes no file.
enum class Signature { now, later };

/// Holds the lock of a directory as long as it lives.
class DirectoryLock {
public:
  /// Throws FileError if another process holds the lock (naming it), or if the directory cannot be
  /// written.
  explicit DirectoryLock(const std::filesystem::path& directory, Signature = Signature::now);
  ~DirectoryLock();

  /// Writes into .lock who holds it, for those who find it locked.
  void sign() const;

  /// Throws FileError if the directory is not where it was: gone, moved, or another one stands in
  /// its place, which this lock does not protect; or if the file .lock is gone or another, so that
  /// another process may have taken that.
  void require_in_place() const;

  /// Whether another process works in the directory at the moment. Writes nothing.
  static bool is_held(const std::filesystem::path& directory);

  DirectoryLock(const DirectoryLock&) = delete;
  DirectoryLock& operator=(const DirectoryLock&) = delete;
  DirectoryLock(DirectoryLock&&) = delete;
  DirectoryLock& operator=(DirectoryLock&&) = delete;

private:
  std::filesystem::path directory_;
  int descriptor_;
  std::optional<FileIdentity> directory_identity_, lock_identity_;
};

}  // namespace riesel::io
