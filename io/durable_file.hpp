// Files that survive whatever happens while they are written: a full disk, a kill, a power failure.
//
// A file is never changed in place. The new content is written to NAME.tmp and flushed to the disk
// (fsync), and only then takes over the name by a rename, which is atomic. Where the previous
// generation is kept, it first gets a second name, so that the steps are
//
//   1. NAME.tmp       written, fsync, close
//   2. NAME.replaced  hard link to NAME
//   3. NAME           renamed from NAME.tmp
//   4. NAME.previous  renamed from NAME.replaced
//   5. the directory  fsync
//
// Between any two of them NAME is a complete generation (once there was one), and so is
// NAME.previous. The older of the two is replaced last: should NAME have been damaged on the disk,
// NAME.previous is the good one, and stays until step 4, when NAME is good again.
#pragma once

#include <filesystem>
#include <string_view>

namespace riesel::io {

enum class Previous { discard, keep };

/// Replaces `path` by a file with this content, which on return is on the disk. If anything fails,
/// throws FileError and leaves no NAME.tmp; the old file is still there or, if step 4 or 5 failed,
/// the new one. If two processes write in the same directory at the same time, the later one waits
/// for the other.
void write_durably(const std::filesystem::path& path, std::string_view content,
                   Previous previous = Previous::discard);

/// Replaces a file by a copy of it, which has no other names; on return it is on the disk. If
/// anything fails, throws FileError and leaves the file and its other names as they are.
void replace_by_copy(const std::filesystem::path& path);

/// Flushes the directory of `path` to the disk, so that what was created there will be found.
/// Throws FileError.
void sync_directory_of(const std::filesystem::path& path);

/// Makes a directory and its missing parents; on return they are on the disk. Throws FileError.
void make_directories(const std::filesystem::path& path);

/// NAME.previous: where the previous generation is kept.
std::filesystem::path previous_generation(const std::filesystem::path& path);

}  // namespace riesel::io
