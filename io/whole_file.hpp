// Files that are read as a whole before anything in them is looked at.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace riesel::io {

/// The bytes of a regular file. Throws FileError if it cannot be read, is something else (a device
/// may have no end), or is longer than `most` bytes or than this machine's memory.
std::vector<char> read_whole_file(const std::filesystem::path& path,
                                  std::uint64_t most = UINT64_MAX);

/// The first `most` bytes of a regular file, fewer if it is shorter; "" if it cannot be read or is
/// something else. By them riesel recognises what it has written itself.
std::string beginning_of(const std::filesystem::path& path, std::uint64_t most);

/// Whether a text file begins with { and ends with }, as a JSON file does that is not cut short.
/// Takes the same short time for a file of any length.
bool is_bracketed(const std::filesystem::path& path);

}  // namespace riesel::io
