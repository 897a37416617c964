// The trees of an HDF5 file, which hold the names of a group's members, and the places of a data
// set's chunks. See stored_hdf5.hpp.
//
// Keys must rise from leaf to leaf, and no node but a root may be empty. So a tree that contains
// itself is found out at its second leaf, and the time to read one is at most proportional to the
// length of the file.
#pragma once

#include "io/bytes.hpp"
#include "io/hdf5_header.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace riesel::io {

/// The members of a group, by name, and the addresses of their headers. Throws Hdf5Error or
/// OutOfBytes.
std::map<std::string, std::uint64_t> read_hdf5_members(const Bytes& file,
                                                       const Hdf5Members& members);

/// The chunks of a data set that is cut along its rows, in order and without their checksums, which
/// have been verified. `chunk_size`: bytes of each, without its checksum; `count`: how many hold
/// all rows. Throws Hdf5Error or OutOfBytes.
std::vector<Bytes> read_hdf5_chunks(const Bytes& file, const Hdf5Layout& layout,
                                    std::uint64_t chunk_size, std::uint64_t count);

/// The checksum that HDF5's filter of this name appends to a chunk. The number of bytes must be
/// even, as it is for all numbers.
std::uint32_t fletcher32(const Bytes& bytes);

}  // namespace riesel::io
