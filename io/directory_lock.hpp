// One process per directory: two runs that write the same files would destroy each other's work.
//
// An flock on the file .lock in the directory. The system drops it when the process ends, however
// it ends, so that no stale lock can stand in the way of a resume. The file stays: removing it
// would let two processes lock two different files of the same name.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace riesel::io {

/// Tells one file from another, whatever their names.
struct FileIdentity {
  std::uint64_t device = 0, inode = 0;
  bool operator==(const FileIdentity&) const = default;
};

/// Whether the process writes its name into the lock at once or only by sign(): one that may still
/// find nothing to do should change no file.
enum class Signature { now, later };

/// The file in the directory that is locked.
inline constexpr auto lock_name = ".lock";

/// What messages say between a directory that another process has locked and that process.
inline constexpr auto in_use_by = "is in use by ";

/// Holds the lock of a directory as long as it lives.
class DirectoryLock {
public:
  /// Throws InUse if another process holds the lock (naming it), FileError if the directory cannot
  /// be written.
  explicit DirectoryLock(const std::filesystem::path& directory, Signature = Signature::now);
  ~DirectoryLock();

  /// Writes into .lock which process holds it, for those who find it locked.
  void sign() const;

  /// Throws FileError if the directory is no longer where it was: it is gone, was moved, or another
  /// one, which this lock does not protect, is in its place; or if the file .lock was removed or
  /// replaced, as another process may then hold the new one.
  void require_in_place() const;

  /// Whether another process holds the lock at the moment. Writes nothing.
  static bool is_held(const std::filesystem::path& directory);

  /// Which process holds the lock at the moment, as messages call it; nothing if none does.
  static std::optional<std::string> holder(const std::filesystem::path& directory);

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
