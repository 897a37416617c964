#include "io/hdf5_outline.hpp"

#include "io/byte_writer.hpp"
#include "io/hdf5_handle.hpp"
#include "io/hdf5_messages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>

namespace riesel::io {
namespace {

constexpr std::uint64_t undefined = UINT64_MAX;  // an address
constexpr std::uint64_t unlimited = UINT64_MAX;  // an extent

// Half the number of entries that a node has room for, by kind of node. The format fixes the third.
constexpr std::size_t leaf_k = 16, group_k = 16, chunk_k = 32;
static_assert(Hdf5Outline::most_members == 2 * leaf_k * 2 * group_k);

void require_at_most(std::size_t most, std::size_t count, const char* what) {
  if (count > most)
    throw Hdf5Error(fmt::format("{} {} are more than the {} there is room for", count, what, most));
}

std::string message(hdf5_message::Type type, const ByteWriter& content) {
  ByteWriter padded;
  padded.text(content.bytes()).align();
  require_at_most(hdf5_largest_message, padded.bytes().size(), "bytes of an attribute");
  return ByteWriter()
      .number(type, 2)
      .number(padded.bytes().size(), 2)
      .zeros(4)
      .text(padded.bytes())
      .bytes();
}

// --- types ---

std::string type_of(std::uint8_t kind, std::uint32_t bits, std::uint64_t size,
                    const ByteWriter& properties) {
  constexpr std::uint8_t version = 1 << 4;
  return ByteWriter()
      .number(version | kind, 1)
      .number(bits, 3)
      .number(size, 4)
      .text(properties.bytes())
      .bytes();
}

std::string integer_type(std::uint64_t size) {
  constexpr std::uint32_t is_signed = 0x08;
  return type_of(0, is_signed, size, ByteWriter().number(0, 2).number(8 * size, 2));
}

/// `exponent` and `mantissa`: bits of these parts of an IEEE 754 number.
std::string real_type(std::uint64_t size, std::uint32_t exponent, std::uint32_t mantissa) {
  constexpr std::uint32_t leading_bit_implied = 0x20;
  const std::uint32_t sign = exponent + mantissa;
  const std::uint32_t bias = (1U << (exponent - 1)) - 1;
  return type_of(1, leading_bit_implied | sign << 8U, size,
                 ByteWriter()
                     .number(0, 2)
                     .number(8 * size, 2)
                     .number(mantissa, 1)
                     .number(exponent, 1)
                     .number(0, 1)
                     .number(mantissa, 1)
                     .number(bias, 4));
}

enum class Padding : std::uint8_t { terminated = 0, zeros = 1 };

std::string text_type(std::uint64_t size, Padding padding) {
  return type_of(3, static_cast<std::uint32_t>(padding), size, {});
}

std::string reference_type() { return type_of(7, 0, 8, {}); }

std::string list_type(const std::string& of) {
  return type_of(9, 0, 16, ByteWriter().text(of));  // count, address of a heap, index there
}

std::string type_of(Hdf5Element element) {
  switch (element) {
  case Hdf5Element::int32:
  case Hdf5Element::int64:
    return integer_type(size_of(element));
  case Hdf5Element::real32:
    return real_type(4, 8, 23);
  case Hdf5Element::real64:
    return real_type(8, 11, 52);
  case Hdf5Element::character:
    return text_type(1, Padding::terminated);
  }
  return {};
}

// --- what headers are made of ---

std::string space(std::span<const std::uint64_t> extent, bool grows = false) {
  ByteWriter space;
  space.number(1, 1).number(extent.size(), 1).number(grows ? 1 : 0, 1).zeros(5);
  for (const auto length : extent) space.number(length, 8);
  for (std::size_t i = 0; grows && i < extent.size(); ++i)
    space.number(i == 0 ? unlimited : extent[i], 8);
  return space.bytes();
}

std::string attribute(const std::string& name, const std::string& type, const std::string& space,
                      const std::string& value) {
  ByteWriter content;
  content.number(1, 1)
      .zeros(1)
      .number(name.size() + 1, 2)
      .number(type.size(), 2)
      .number(space.size(), 2);
  content.text(name).zeros(1).align().text(type).align().text(space).align().text(value);
  return message(hdf5_message::attribute, content);
}

std::string fill_message(const Hdf5DataPlan& plan) {
  constexpr std::uint8_t version = 2, when_written = 3, if_set = 2, defined = 1;
  ByteWriter fill;
  fill.number(version, 1).number(when_written, 1).number(if_set, 1).number(defined, 1);
  if (plan.element == Hdf5Element::real32 && plan.fill != 0.0)
    fill.number(4, 4).number(std::bit_cast<std::uint32_t>(static_cast<float>(plan.fill)), 4);
  else
    fill.number(0, 4);
  return message(hdf5_message::fill, fill);
}

/// Each dimension has a list of one scale.
std::string dimension_list(const std::vector<Hdf5Scale>& scales) {
  const std::array<std::uint64_t, 1> extent = {scales.size()};
  ByteWriter lists;
  for (const Hdf5Scale& scale : scales)
    lists.number(1, 4).number(scale.heap, 8).number(scale.index, 4);
  return attribute("DIMENSION_LIST", list_type(reference_type()), space(extent), lists.bytes());
}

/// A node of a tree, padded to the size of all nodes of its kind.
std::string tree_node(std::uint8_t kind, std::uint8_t level, std::size_t entries,
                      const std::array<std::uint64_t, 2>& siblings, const std::string& content,
                      std::size_t most_content) {
  ByteWriter node;
  node.text("TREE").number(kind, 1).number(level, 1).number(entries, 2);
  node.number(siblings[0], 8).number(siblings[1], 8).text(content);
  return node.zeros(most_content - content.size()).bytes();
}

}  // namespace

std::uint64_t size_of(Hdf5Element element) {
  switch (element) {
  case Hdf5Element::int32:
  case Hdf5Element::real32:
    return 4;
  case Hdf5Element::int64:
  case Hdf5Element::real64:
    return 8;
  case Hdf5Element::character:
    return 1;
  }
  return 0;
}

// --- attributes ---

void Hdf5Attributes::add(const std::string& name, const std::string& type,
                         std::span<const std::uint64_t> extent, const std::string& value) {
  messages_.push_back(attribute(name, type, space(extent), value));
}

Hdf5Attributes& Hdf5Attributes::add(const std::string& name, std::string_view text) {
  const std::string value = text.empty() ? std::string(1, '\0') : std::string(text);
  add(name, text_type(value.size(), Padding::zeros), {}, value);
  return *this;
}

Hdf5Attributes& Hdf5Attributes::add(const std::string& name, std::int64_t number) {
  add(name, integer_type(8), {},
      ByteWriter().number(static_cast<std::uint64_t>(number), 8).bytes());
  return *this;
}

Hdf5Attributes& Hdf5Attributes::add(const std::string& name,
                                    std::initializer_list<std::int32_t> numbers) {
  const std::array<std::uint64_t, 1> extent = {numbers.size()};
  ByteWriter value;
  for (const auto number : numbers) value.number(static_cast<std::uint32_t>(number), 4);
  add(name, integer_type(4), extent, value.bytes());
  return *this;
}

Hdf5Attributes& Hdf5Attributes::add(const std::string& name,
                                    std::initializer_list<std::string_view> texts) {
  const std::array<std::uint64_t, 1> extent = {texts.size()};
  std::size_t length = 1;
  for (const auto text : texts) length = std::max(length, text.size());
  ByteWriter value;
  for (const auto text : texts) value.text(text).zeros(length - text.size());
  add(name, text_type(length, Padding::zeros), extent, value.bytes());
  return *this;
}

Hdf5Attributes& Hdf5Attributes::add_scale(const std::string& name, bool has_values) {
  const auto add_terminated = [&](const std::string& attribute, std::string text) {
    text.push_back('\0');
    add(attribute, text_type(text.size(), Padding::terminated), {}, text);
  };
  add_terminated("CLASS", "DIMENSION_SCALE");
  // The text by which netCDF recognises it.
  add_terminated("NAME",
                 has_values ? name : "This is a netCDF dimension but not a netCDF variable.");
  return *this;
}

// --- objects ---

std::uint64_t Hdf5Outline::add(std::string_view bytes) {
  const auto place = address_ + bytes_.size();
  bytes_ += bytes;
  bytes_.resize(padded_to_8(bytes_.size()), '\0');
  return place;
}

std::uint64_t Hdf5Outline::add_elements(std::string_view bytes) { return add(bytes); }

std::uint64_t Hdf5Outline::add_header(const std::vector<std::string>& messages) {
  std::size_t size = 0;
  for (const auto& message : messages) size += message.size();
  ByteWriter header;
  header.number(1, 1).zeros(1).number(messages.size(), 2).number(1, 4).number(size, 4).zeros(4);
  for (const auto& message : messages) header.text(message);
  return add(header.bytes());
}

/// Nodes of 64 chunks, above them nodes of 64 nodes, and so on up to a single one.
std::uint64_t Hdf5Outline::add_chunk_tree(const Hdf5DataPlan& plan) {
  const std::size_t rank = plan.extent.size();
  std::uint64_t chunk_size = plan.rows_per_chunk * size_of(plan.element);
  for (std::size_t i = 1; i < rank; ++i) chunk_size *= plan.extent[i];
  const auto key = [&](std::uint64_t chunk) {
    return ByteWriter()
        .number(chunk_size, 4)
        .zeros(4)
        .number(chunk * plan.rows_per_chunk, 8)
        .zeros(8 * rank)
        .bytes();
  };
  const std::size_t key_size = 16 + 8 * rank;
  const std::size_t most_content = 2 * chunk_k * (key_size + 8) + key_size;

  std::vector<std::uint64_t> below(plan.chunks.begin(), plan.chunks.end());
  std::uint64_t chunks_per_child = 1;
  for (std::uint8_t level = 0; level == 0 || below.size() > 1; ++level) {
    const std::size_t nodes = (below.size() + 2 * chunk_k - 1) / (2 * chunk_k);
    const std::uint64_t node_size = 24 + most_content;
    const std::uint64_t first = address_ + bytes_.size();
    std::vector<std::uint64_t> here;
    for (std::size_t n = 0; n < nodes; ++n) {
      const std::size_t begin = n * 2 * chunk_k;
      const std::size_t end = std::min(begin + 2 * chunk_k, below.size());
      ByteWriter content;
      for (std::size_t i = begin; i < end; ++i)
        content.text(key(i * chunks_per_child)).number(below[i], 8);
      content.text(key(std::min<std::uint64_t>(end * chunks_per_child, plan.chunks.size())));
      here.push_back(add(tree_node(1, level, end - begin,
                                   {n == 0 ? undefined : first + (n - 1) * node_size,
                                    n + 1 == nodes ? undefined : first + (n + 1) * node_size},
                                   content.bytes(), most_content)));
    }
    below = std::move(here);
    chunks_per_child *= 2 * chunk_k;
  }
  return below.front();
}

std::string Hdf5Outline::layout_message(const Hdf5DataPlan& plan) {
  constexpr std::uint8_t version = 3, in_one_piece = 1, in_chunks = 2;
  ByteWriter layout;
  layout.number(version, 1);
  if (plan.rows_per_chunk == 0) {
    std::uint64_t size = size_of(plan.element);
    for (const auto length : plan.extent) size *= length;
    layout.number(in_one_piece, 1).number(plan.piece == 0 ? undefined : plan.piece, 8);
    return message(hdf5_message::layout, layout.number(size, 8));
  }
  layout.number(in_chunks, 1).number(plan.extent.size() + 1, 1);
  layout.number(plan.chunks.empty() ? undefined : add_chunk_tree(plan), 8);
  layout.number(plan.rows_per_chunk, 4);
  for (std::size_t i = 1; i < plan.extent.size(); ++i) layout.number(plan.extent[i], 4);
  return message(hdf5_message::layout, layout.number(size_of(plan.element), 4));
}

std::uint64_t Hdf5Outline::add_data(const Hdf5DataPlan& plan) {
  std::vector<std::string> messages = {
      message(hdf5_message::space, ByteWriter().text(space(plan.extent, plan.rows_per_chunk > 0))),
      message(hdf5_message::type, ByteWriter().text(type_of(plan.element))),
      fill_message(plan),
      layout_message(plan),
  };
  const auto& attributes = plan.attributes.messages_;
  messages.insert(messages.end(), attributes.begin(), attributes.end());
  if (!plan.scales.empty()) messages.push_back(dimension_list(plan.scales));
  return add_header(messages);
}

/// The names go into a heap, the entries into leaves in the order of the names, and the leaves into
/// a tree of one node.
std::uint64_t Hdf5Outline::add_group(const std::map<std::string, std::uint64_t>& members,
                                     const Hdf5Attributes& attributes) {
  require_at_most(most_members, members.size(), "members of a group");
  ByteWriter names;
  names.zeros(8);  // the empty name, with which the tree begins
  ByteWriter tree, leaf;
  tree.number(0, 8);
  std::size_t in_leaf = 0, leaves = 0, done = 0;
  for (const auto& [name, place] : members) {
    const std::size_t offset = names.bytes().size();
    names.text(name).zeros(1).align();
    leaf.number(offset, 8).number(place, 8).zeros(24);
    ++done;
    if (++in_leaf < 2 * leaf_k && done < members.size()) continue;
    ByteWriter whole;
    whole.text("SNOD").number(1, 1).zeros(1).number(in_leaf, 2).text(leaf.bytes());
    whole.zeros((2 * leaf_k - in_leaf) * 40);
    tree.number(add(whole.bytes()), 8).number(offset, 8);
    leaf = {};
    in_leaf = 0;
    ++leaves;
  }
  constexpr std::uint64_t nothing_free = 1;
  const auto content = add(names.bytes());
  const auto heap = add(ByteWriter()
                            .text("HEAP")
                            .zeros(4)
                            .number(names.bytes().size(), 8)
                            .number(nothing_free, 8)
                            .number(content, 8)
                            .bytes());
  const auto root =
      add(tree_node(0, 0, leaves, {undefined, undefined}, tree.bytes(), (4 * group_k + 1) * 8));
  std::vector<std::string> messages = {
      message(hdf5_message::members, ByteWriter().number(root, 8).number(heap, 8))};
  messages.insert(messages.end(), attributes.messages_.begin(), attributes.messages_.end());
  return add_header(messages);
}

std::vector<Hdf5Scale> Hdf5Outline::add_references(std::span<const std::uint64_t> data_sets) {
  constexpr std::size_t heap_size = 4096, head_size = 16, reference_size = 24;
  static_assert(head_size + most_references * reference_size + head_size <= heap_size);
  require_at_most(most_references, data_sets.size(), "references");
  const std::uint64_t heap = address_ + bytes_.size();
  std::vector<Hdf5Scale> scales;
  ByteWriter collection;
  collection.text("GCOL").number(1, 1).zeros(3).number(heap_size, 8);
  for (const auto data_set : data_sets) {
    scales.push_back({.heap = heap, .index = static_cast<std::uint32_t>(scales.size() + 1)});
    collection.number(scales.back().index, 2).number(1, 2).zeros(4).number(8, 8);
    collection.number(data_set, 8);
  }
  const std::size_t free = heap_size - collection.bytes().size();
  collection.zeros(8).number(free, 8).zeros(free - head_size);
  add(collection.bytes());
  return scales;
}

std::string hdf5_superblock(std::uint64_t root, std::uint64_t end_of_file) {
  constexpr std::string_view signature("\x89HDF\r\n\x1a\n", 8);
  ByteWriter block;
  block.text(signature).zeros(5).number(8, 1).number(8, 1).zeros(1);
  block.number(leaf_k, 2).number(group_k, 2).zeros(4);
  block.number(0, 8).number(undefined, 8).number(end_of_file, 8).number(undefined, 8);
  return block.number(0, 8).number(root, 8).zeros(24).bytes();
}

}  // namespace riesel::io
