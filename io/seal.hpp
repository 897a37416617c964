// The seal of a file that holds HDF5: its first 512 bytes, a text that gives the kind of file, its
// length and two checksums of all that follows.
//
// HDF5 skips such a user block. Changing one byte always changes either checksum (FNV-1a: each byte
// goes in by a one-to-one map); any other damage passes both in one case of 2^96. The CRC-32 is for
// the Python package, which would need minutes for the other one; riesel itself reads files without
// it, as riesel 0.10 and before wrote them. The seal guards against accidents: anyone who wants to
// deceive can make it right, see stored_hdf5.hpp.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace riesel::io {

inline constexpr std::size_t seal_size = 512;  ///< bytes

/// Writes the seal into the first bytes of a file's image. `kind`: of file, such as "checkpoint".
void seal(std::span<char> image, std::string_view kind);

/// How the file differs from one of this kind as it was sealed; empty if it does not.
std::string flaw_of_seal(std::span<const char> image, std::string_view kind);

}  // namespace riesel::io
