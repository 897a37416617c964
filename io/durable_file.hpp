// Files that survive whatever happens while they are written: a full disk, a kill, a power failure.
//
// A file is never changed in place. The new content goes aside to NAME.tmp and to the disk (fsync),
// and only then takes the name over by a rename, which is atomic. Where the generation before is
// kept, it first gets a second name, so that the steps are
//
//   1. NAME.tmp       written, fsync, close
//   2. NAME.replaced  hard link to NAME
//   3. NAME           renamed from NAME.tmp
//   4. NAME.previous  renamed from NAME.replaced
//   5. the directory  fsync
//
// Between any two of them NAME is a complete generation (once there was one), and so is
// NAME.previous. In particular the older of the two goes last: should NAME have been damaged on the
// disk, NAME.previous is the good one and stays until step 4, after NAME has become good.
#pragma once

#include <filesystem>
#include <string_view>

namespace riesel::io {

enum class Previous { discard, keep };

/// Replaces `path` by a file with this content; on return it is on the disk. If anything fails, a
/// FileError is thrown and NAME.tmp is gone; the old file is still there, or, if it was step 4 or 5
/// that failed, the new one. Of two who write in the same directory at the same time the later one
/// waits for the other.
void write_durably(const std::filesystem::path& path, std::string_view content,
                   Previous previous = Previous::discard);

/// What has been made at `path` will be found there: its directory is on the disk. Throws
/// FileError.
void sync_directory_of(const std::filesystem::path& path);

/// Makes a directory and those above it that are missing, each to be found on the disk from then
/// on. Throws FileError.
void make_directories(const std::filesystem::path& path);

/// NAME.previous: where the generation before is kept.
std::filesystem::path previous_generation(const std::filesystem::path& path);

}  // namespace riesel::io
