// The seal of a checkpoint: its first 512 bytes, a text that tells what the file is, its length and
// a checksum of all that follows.
//
// HDF5 skips such a user block. Any change of one byte changes the checksum (FNV-1a: each byte goes
// in by a one-to-one map), any other damage does so but for one case in 2^64.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace riesel::io {

inline constexpr std::size_t seal_size = 512;  ///< bytes

/// Writes the seal into the first bytes of the image of a file.
void seal(std::span<char> image);

/// Reads the file once and tells how it differs from what was sealed; empty if it does not. Throws
/// FileError if it cannot be read.
std::string flaw_of_seal(const std::filesystem::path& path);

}  // namespace riesel::io
