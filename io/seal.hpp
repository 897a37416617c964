// The seal of a file that holds HDF5: its first 512 bytes, a text that tells what the file is, its
// length and a checksum of all that follows.
//
// HDF5 skips such a user block. Any change of one byte changes the checksum (FNV-1a: each byte goes
// in by a one-to-one map), any other damage does so but for one case in 2^64. The seal is against
// accidents: who wants to deceive can make it right, see stored_hdf5.hpp.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace riesel::io {

inline constexpr std::size_t seal_size = 512;  ///< bytes

/// Writes the seal into the first bytes of the image of a file. `kind` is what it is: "checkpoint".
void seal(std::span<char> image, std::string_view kind);

/// How a file differs from what was sealed; empty if it does not.
std::string flaw_of_seal(std::span<const char> image, std::string_view kind);

}  // namespace riesel::io
