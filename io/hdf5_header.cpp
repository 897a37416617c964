#include "io/hdf5_header.hpp"

#include "io/hdf5_handle.hpp"
#include "io/hdf5_messages.hpp"

#include <array>
#include <string_view>
#include <utility>

namespace riesel::io {
namespace {

using namespace std::string_view_literals;

constexpr std::size_t prefix_size = 16, message_head_size = 8;
constexpr std::uint64_t shared_message = 0x2;  // flag: the message is elsewhere

// How HDF5 encodes the types of numbers that this program writes.
struct NumberType {
  Hdf5Type type;
  std::string_view encoding;
};
constexpr std::array number_types = {
    NumberType{{Hdf5Type::Kind::int32, 4}, "\x10\x08\0\0\x04\0\0\0\0\0\x20\0"sv},
    NumberType{{Hdf5Type::Kind::int64, 8}, "\x10\x08\0\0\x08\0\0\0\0\0\x40\0"sv},
    NumberType{{Hdf5Type::Kind::uint64, 8}, "\x10\0\0\0\x08\0\0\0\0\0\x40\0"sv},
    NumberType{{Hdf5Type::Kind::real64, 8},
               "\x11\x20\x3f\0\x08\0\0\0\0\0\x40\0\x34\x0b\0\x34\xff\x03\0\0"sv}};

Hdf5Type read_type(const Bytes& body) {
  for (const auto& [type, encoding] : number_types)
    if (body.text().starts_with(encoding)) return type;
  constexpr std::uint64_t text_of_fixed_length = 0x13;
  require(body.number(0, 1) == text_of_fixed_length, "it has a type that is never written");
  const auto size = body.number(4, 4);
  require(size > 0, "it is a text without length");
  return {.kind = Hdf5Type::Kind::text, .size = size};
}

std::vector<std::uint64_t> read_extent(const Bytes& body) {
  require(body.number(0, 1) == 1, "its extent has another version");
  const auto dimensions = body.number(1, 1);
  require(dimensions <= 2, "it is not a table");
  std::vector<std::uint64_t> extent;
  for (std::uint64_t i = 0; i < dimensions; ++i) extent.push_back(body.number(8 + 8 * i, 8));
  return extent;
}

Hdf5Layout read_layout(const Bytes& body) {
  constexpr std::uint64_t in_one_piece = 1, in_chunks = 2;
  require(body.number(0, 1) == 3, "its layout has another version");
  const auto layout_class = body.number(1, 1);
  if (layout_class == in_one_piece)
    return {
        .chunked = false, .address = body.number(2, 8), .size = body.number(10, 8), .chunk = {}};
  require(layout_class == in_chunks, "it has a layout that is never written");
  Hdf5Layout found{.chunked = true, .address = body.number(3, 8), .size = 0, .chunk = {}};
  const auto dimensions = body.number(2, 1);  // the last one is the size of an element
  for (std::uint64_t i = 0; i < dimensions; ++i) found.chunk.push_back(body.number(11 + 4 * i, 4));
  return found;
}

/// The one filter that this program uses.
void require_fletcher32(const Bytes& body) {
  constexpr std::uint64_t fletcher32 = 3;
  require(body.number(0, 1) == 1 && body.number(1, 1) == 1 && body.number(8, 2) == fletcher32,
          "it has a filter that is never written");
}

std::pair<std::string, Hdf5Attribute> read_attribute(const Bytes& body) {
  require(body.number(0, 1) == 1, "an attribute has another version");
  const auto name_size = body.number(2, 2), type_size = body.number(4, 2),
             extent_size = body.number(6, 2);
  // HDF5 pads each part of an attribute.
  const std::uint64_t name_at = 8, type_at = name_at + padded_to_8(name_size),
                      extent_at = type_at + padded_to_8(type_size),
                      value_at = extent_at + padded_to_8(extent_size);
  const auto name = body.part(name_at, name_size).text();
  return {std::string(name.substr(0, name.find('\0'))),
          {.type = read_type(body.part(type_at, type_size)),
           .extent = read_extent(body.part(extent_at, extent_size)),
           .value = body.from(value_at)}};
}

/// Puts what the message says into the header; messages that no reader needs are skipped.
void take(std::uint64_t message, const Bytes& body, Hdf5Header& header) {
  switch (message) {
  case hdf5_message::space:
    header.extent = read_extent(body);
    break;
  case hdf5_message::type:
    header.type = read_type(body);
    break;
  case hdf5_message::layout:
    header.layout = read_layout(body);
    break;
  case hdf5_message::filters:
    require_fletcher32(body);
    header.has_checksums = true;
    break;
  case hdf5_message::attribute:
    header.attributes.insert(read_attribute(body));
    break;
  case hdf5_message::members:
    header.members = {.tree = body.number(0, 8), .heap = body.number(8, 8)};
    break;
  default:
    break;
  }
}

bool is_of_use(std::uint64_t message) {
  return message == hdf5_message::space || message == hdf5_message::type
         || message == hdf5_message::layout || message == hdf5_message::filters
         || message == hdf5_message::attribute || message == hdf5_message::continuation
         || message == hdf5_message::members;
}

}  // namespace

Hdf5Header read_hdf5_header(const Bytes& file, std::uint64_t address) {
  const Bytes prefix = file.part(address, prefix_size);
  require(prefix.number(0, 1) == 1, "the header of an object has another version");
  Hdf5Header header;
  std::vector<Bytes> blocks = {
      file.part(address, prefix_size + prefix.number(8, 4)).from(prefix_size)};
  std::size_t block = 0;
  std::uint64_t place = 0;
  for (auto left = prefix.number(2, 2); left > 0; --left) {
    while (block < blocks.size() && blocks[block].size() - place < message_head_size) {
      ++block;
      place = 0;
    }
    require(block < blocks.size(), "the header of an object has fewer messages than it says");
    const Bytes rest = blocks[block].from(place);
    const auto message = rest.number(0, 2), size = rest.number(2, 2);
    const Bytes body = rest.part(message_head_size, size);
    if (is_of_use(message))
      require((rest.number(4, 1) & shared_message) == 0, "the header of an object is not its own");
    if (message == hdf5_message::continuation)
      blocks.push_back(file.part(body.number(0, 8), body.number(8, 8)));
    else
      take(message, body, header);
    place += message_head_size + size;
  }
  return header;
}

}  // namespace riesel::io
