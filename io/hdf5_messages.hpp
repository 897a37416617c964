// The messages that make up the header of an HDF5 object, as the format numbers them.
#pragma once

#include <cstdint>

namespace riesel::io::hdf5_message {

enum Type : std::uint16_t {
  space = 0x01,
  type = 0x03,
  fill = 0x05,
  layout = 0x08,
  filters = 0x0b,
  attribute = 0x0c,
  continuation = 0x10,
  members = 0x11,  // of a group: where its tree and its names are
};

}  // namespace riesel::io::hdf5_message
