// Outlines up to the limits that they have, as HDF5's library reads them, and not beyond.
#include "io/hdf5_outline.hpp"

#include "io/hdf5_file.hpp"
#include "tests/io/file_fixture.hpp"

#include <map>
#include <string>
#include <vector>

using namespace riesel::io;
using namespace file_fixture;

namespace {

/// Empty groups: "0", "1", ...
std::map<std::string, std::uint64_t> many_members(Hdf5Outline& outline, std::size_t count) {
  const std::uint64_t empty = outline.add_group({});
  std::map<std::string, std::uint64_t> members;
  for (std::size_t i = 0; i < count; ++i) members.emplace(std::to_string(i), empty);
  return members;
}

void write(const fs::path& path, const Hdf5Outline& outline, std::uint64_t root) {
  const std::uint64_t end = hdf5_superblock_size + outline.bytes().size();
  overwrite(path, hdf5_superblock(root, end) + outline.bytes());
}

}  // namespace

TEST_CASE("a group has as many members as its limit, and no more") {
  const ScratchDirectory directory;
  Hdf5Outline outline(hdf5_superblock_size);
  const auto root = outline.add_group(many_members(outline, Hdf5Outline::most_members));
  write(directory / "file.h5", outline, root);
  const auto group = Hdf5File::open(directory / "file.h5").root();
  for (std::size_t i = 0; i < Hdf5Outline::most_members; ++i) CHECK(group.has(std::to_string(i)));
  CHECK_FALSE(group.has("-1"));
  const auto too_many = many_members(outline, Hdf5Outline::most_members + 1);
  CHECK(message_of<Hdf5Error>([&] { outline.add_group(too_many); })
        == "1025 members of a group are more than the 1024 there is room for");
}

TEST_CASE("an attribute is as long as its limit, and no longer") {
  const ScratchDirectory directory;
  constexpr std::size_t without_text = 32;  // of the head, name, type and space
  const std::string longest(hdf5_largest_message - without_text, 'x');
  Hdf5Outline outline(hdf5_superblock_size);
  write(directory / "file.h5", outline, outline.add_group({}, Hdf5Attributes().add("a", longest)));
  CHECK(Hdf5File::open(directory / "file.h5").root().text_attribute("a") == longest);
  CHECK(message_of<Hdf5Error>([&] { Hdf5Attributes().add("a", longest + "x"); })
        == "65536 bytes of an attribute are more than the 65528 there is room for");
}

TEST_CASE("a heap has as many references as its limit, and no more") {
  Hdf5Outline outline(hdf5_superblock_size);
  const std::vector<std::uint64_t> most(Hdf5Outline::most_references, 8);
  CHECK(outline.add_references(most).size() == most.size());
  CHECK(outline.bytes().size() == 4096);
  const std::vector<std::uint64_t> more(most.size() + 1, 8);
  CHECK_THROWS_AS(outline.add_references(more), Hdf5Error);
}
