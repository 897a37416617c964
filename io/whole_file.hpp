// Files that are read as a whole before anything in them is looked at.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace riesel::io {

/// The bytes of a regular file. Throws FileError if it cannot be read, is something else (a device
/// may have no end), or is longer than `most` bytes or than this machine's memory.
std::vector<char> read_whole_file(const std::filesystem::path& path,
                                  std::uint64_t most = UINT64_MAX);

}  // namespace riesel::io
