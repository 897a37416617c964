#include "io/hdf5_trees.hpp"

#include "io/hdf5_handle.hpp"

#include <algorithm>
#include <string_view>

namespace riesel::io {
namespace {

constexpr std::uint64_t node_head_size = 24;
// Four levels hold more than 10^6 chunks.
constexpr std::uint64_t highest_level = 8;

/// A node of a tree: a key, a child, a key, a child, ...
struct Node {
  Bytes entries;
  std::uint64_t level, size;  // 0 for leaves; number of children
};

Node read_node(const Bytes& file, std::uint64_t address, std::uint64_t type) {
  const Bytes bytes = file.from(address);
  require(bytes.part(0, 4).text() == "TREE" && bytes.number(4, 1) == type,
          "there is no tree where one should be");
  return {.entries = bytes.from(node_head_size),
          .level = bytes.number(5, 1),
          .size = bytes.number(6, 2)};
}

/// Calls visit(key, address of the child) for all leaves, from left to right.
template <class Visit>
void for_each_leaf(const Bytes& file, std::uint64_t address, std::uint64_t type,
                   std::uint64_t key_size, std::uint64_t level, Visit& visit) {
  const Node node = read_node(file, address, type);
  require(node.level == level && node.size > 0, "a tree is damaged");
  for (std::uint64_t i = 0; i < node.size; ++i) {
    const Bytes entry = node.entries.part(i * (key_size + 8), key_size + 8);
    const auto child = entry.number(key_size, 8);
    if (level > 0)
      for_each_leaf(file, child, type, key_size, level - 1, visit);
    else
      visit(entry, child);
  }
}

/// The same from the root, which alone may be empty.
template <class Visit>
void for_all_leaves(const Bytes& file, std::uint64_t address, std::uint64_t type,
                    std::uint64_t key_size, Visit visit) {
  const Node root = read_node(file, address, type);
  require(root.level <= highest_level, "a tree is too high");
  if (root.size > 0) for_each_leaf(file, address, type, key_size, root.level, visit);
}

Bytes read_heap(const Bytes& file, std::uint64_t address) {
  const Bytes head = file.part(address, 32);
  require(head.part(0, 4).text() == "HEAP" && head.number(4, 1) == 0, "the names are damaged");
  return file.part(head.number(24, 8), head.number(8, 8));
}

std::string name_in(const Bytes& heap, std::uint64_t offset) {
  const auto rest = heap.from(offset).text();
  const auto end = rest.find('\0');
  require(end != std::string_view::npos && end > 0, "a name is damaged");
  return std::string(rest.substr(0, end));
}

}  // namespace

std::map<std::string, std::uint64_t> read_hdf5_members(const Bytes& file,
                                                       const Hdf5Members& members) {
  constexpr std::uint64_t of_groups = 0, key_size = 8, entry_size = 40, link = 2;
  const Bytes heap = read_heap(file, members.heap);
  std::map<std::string, std::uint64_t> found;
  std::uint64_t letters = 0;
  const auto take_leaf = [&](const Bytes&, std::uint64_t address) {
    const Bytes leaf = file.from(address);
    require(leaf.part(0, 4).text() == "SNOD" && leaf.number(4, 1) == 1, "a group is damaged");
    const auto size = leaf.number(6, 2);
    require(size > 0, "a group is damaged");
    for (std::uint64_t i = 0; i < size; ++i) {
      const Bytes entry = leaf.part(8 + i * entry_size, entry_size);
      require(entry.number(16, 4) != link, "a group holds links");
      const auto name = name_in(heap, entry.number(0, 8));
      require(found.empty() || found.rbegin()->first < name, "the names are out of order");
      letters += name.size();
      require(letters <= heap.size(), "the names overlap");
      found.emplace_hint(found.end(), name, entry.number(8, 8));
    }
  };
  for_all_leaves(file, members.tree, of_groups, key_size, take_leaf);
  return found;
}

std::vector<Bytes> read_hdf5_chunks(const Bytes& file, const Hdf5Layout& layout,
                                    std::uint64_t chunk_size, std::uint64_t count) {
  constexpr std::uint64_t of_chunks = 1, checksum_size = 4;
  const std::uint64_t key_size = 8 + 8 * layout.chunk.size();
  std::vector<Bytes> found;
  const auto take_chunk = [&](const Bytes& key, std::uint64_t address) {
    require(found.size() < count, "it has too many chunks");
    const auto first_row = key.number(8, 8);
    require(first_row == found.size() * layout.chunk.front(), "its chunks are out of order");
    require(key.number(0, 4) == chunk_size + checksum_size && key.number(4, 4) == 0,
            "a chunk has another size");
    const Bytes chunk = file.part(address, chunk_size);
    const auto checksum = file.number(address + chunk_size, checksum_size);
    require(checksums_are_forged || fletcher32(chunk) == checksum, "a checksum is wrong");
    found.push_back(chunk);
  };
  for_all_leaves(file, layout.address, of_chunks, key_size, take_chunk);
  require(found.size() == count, "chunks are missing");
  return found;
}

std::uint32_t fletcher32(const Bytes& bytes) {
  constexpr std::size_t words_without_overflow = 360;
  const auto byte = [&](std::size_t i) {
    return static_cast<std::uint32_t>(static_cast<unsigned char>(bytes.data()[i]));
  };
  const auto fold = [](std::uint32_t sum) { return (sum & 0xffffU) + (sum >> 16U); };
  std::uint32_t sum = 0, sum_of_sums = 0;
  const std::size_t words = bytes.size() / 2;
  for (std::size_t word = 0; word < words;) {
    const std::size_t end = std::min(words, word + words_without_overflow);
    for (; word < end; ++word) {
      sum += byte(2 * word) << 8U | byte(2 * word + 1);
      sum_of_sums += sum;
    }
    sum = fold(sum);
    sum_of_sums = fold(sum_of_sums);
  }
  return fold(sum_of_sums) << 16U | fold(sum);
}

}  // namespace riesel::io
