// The header of an object in an HDF5 file (version 1 of the format of headers): what a group or a
// data set says of itself. See stored_hdf5.hpp for who reads it, and why.
//
// https://docs.hdfgroup.org/hdf5/v1_14/_f_m_t3.html, section IV.
#pragma once

#include "io/bytes.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace riesel::io {

/// Text of fixed length, or numbers as this program writes them.
struct Hdf5Type {
  enum class Kind { int32, int64, uint64, real64, text };
  Kind kind;
  std::uint64_t size;  ///< bytes of an element
};

struct Hdf5Attribute {
  Hdf5Type type;
  std::vector<std::uint64_t> extent;  ///< empty for a single value
  Bytes value;
};

/// Where the members of a group stand.
struct Hdf5Members {
  std::uint64_t tree;
  std::uint64_t heap;  ///< of their names
};

/// Where the elements of a data set stand: in one piece, or in chunks.
struct Hdf5Layout {
  bool chunked;
  std::uint64_t address;             ///< of the piece, or of the tree of chunks
  std::uint64_t size;                ///< bytes of the piece
  std::vector<std::uint64_t> chunk;  ///< elements of a chunk along each dimension, bytes of one
};

struct Hdf5Header {
  std::optional<Hdf5Members> members;  ///< of a group
  std::optional<Hdf5Type> type;        ///< of a data set, and all that follows
  std::optional<std::vector<std::uint64_t>> extent;
  std::optional<Hdf5Layout> layout;
  bool has_checksums = false;  ///< fletcher32 with each chunk
  std::map<std::string, Hdf5Attribute> attributes;
};

/// Reads the header at `address`; addresses are offsets in `file`. Throws Hdf5Error or OutOfBytes
/// for what this program does not write.
Hdf5Header read_hdf5_header(const Bytes& file, std::uint64_t address);

}  // namespace riesel::io
