// The header of an object in an HDF5 file (version 1 of the header format): what a group or a data
// set says about itself. See stored_hdf5.hpp for what it is used for.
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

/// Where the members of a group are: addresses.
struct Hdf5Members {
  std::uint64_t tree;
  std::uint64_t heap;  ///< of their names
};

/// Where the elements of a data set are: in one piece, or in chunks.
struct Hdf5Layout {
  bool chunked;
  std::uint64_t address;  ///< of the piece, or of the tree of chunks
  std::uint64_t size;     ///< bytes of the piece
  /// Elements of a chunk along each dimension, then bytes of an element.
  std::vector<std::uint64_t> chunk;
};

struct Hdf5Header {
  std::optional<Hdf5Members> members;  ///< of a group only
  std::optional<Hdf5Type> type;        ///< of a data set only, as are the next three
  std::optional<std::vector<std::uint64_t>> extent;
  std::optional<Hdf5Layout> layout;
  bool has_checksums = false;  ///< fletcher32, for each chunk
  std::map<std::string, Hdf5Attribute> attributes;
};

/// Reads the header at `address`; addresses are offsets in `file`. Throws Hdf5Error or OutOfBytes
/// for anything that this program does not write.
Hdf5Header read_hdf5_header(const Bytes& file, std::uint64_t address);

}  // namespace riesel::io
