// HDF5 read without trust: what the library wrote is read as the library reads it, and what would
// lead a reader astray is refused.
#include "io/stored_hdf5.hpp"

#include "io/hdf5_file.hpp"
#include "tests/io/file_fixture.hpp"

#include <cstring>
#include <functional>

using namespace riesel::io;
using namespace file_fixture;

namespace {

/// A file with a group /g, in it the table /g/t of so many rows, growing or not, and the text /g/x.
std::vector<char> image_of_table(std::size_t rows, bool growing) {
  auto file = Hdf5File::create();
  {
    auto group = file.root().create_group("g");
    group.set_attribute("number", 0.1);
    auto table = group.create_data<std::int64_t>(
        "t", {.rows = growing ? 0 : rows, .columns = 2, .growing = growing});
    std::vector<std::int64_t> values(2 * rows);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<std::int64_t>(i * i);
    if (growing)
      table.append(std::span<const std::int64_t>(values));
    else
      table.write(std::span<const std::int64_t>(values));
    table.set_attribute("unit", "m");
    group.write_text("x", "Rüttelsieb");
  }
  const auto image = file.image();
  return {image.begin(), image.end()};
}

std::vector<std::int64_t> read_table(std::vector<char> bytes) {
  const auto table = stored_hdf5(std::move(bytes), 0).group("g").data("t");
  std::vector<std::int64_t> values(table.shape().rows * table.shape().columns);
  table.read(std::span(values));
  return values;
}

std::string complaint(const std::vector<char>& bytes) {
  return message_of<Hdf5Error>([&] { read_table(bytes); });
}

std::size_t place_of(const std::vector<char>& bytes, const std::string& text, int number = 0) {
  const std::string all(bytes.begin(), bytes.end());
  auto place = all.find(text);
  for (; number > 0; --number) place = all.find(text, place + 1);
  REQUIRE(place != std::string::npos);
  return place;
}

void put(std::vector<char>& bytes, std::size_t place, std::uint64_t value, std::size_t width = 8) {
  std::memcpy(&bytes.at(place), &value, width);
}

std::uint64_t word(const std::vector<char>& bytes, std::size_t place) {
  std::uint64_t value = 0;
  std::memcpy(&value, &bytes.at(place), sizeof value);
  return value;
}

}  // namespace

TEST_CASE("Tables of any size come back, in one chunk, many, or a tree of them") {
  const bool growing = GENERATE(false, true);
  const auto rows = GENERATE(0U, 1U, 1023U, 1025U, 70'001U);  // 64 chunks of 1024 fit into one node
  const auto values = read_table(image_of_table(rows, growing));
  REQUIRE(values.size() == 2 * std::size_t{rows});
  bool equal = true;
  for (std::size_t i = 0; i < values.size(); ++i)
    equal = equal && values[i] == static_cast<std::int64_t>(i * i);
  CHECK(equal);
}

TEST_CASE("Attributes and texts come back, and what is not there is told") {
  const auto group = stored_hdf5(image_of_table(3, false), 0).group("g");
  CHECK(group.attribute<double>("number") == 0.1);
  CHECK(group.data("t").text_attribute("unit") == "m");
  CHECK(group.text("x") == "Rüttelsieb");
  CHECK(group.names() == std::vector<std::string>{"t", "x"});
  CHECK_FALSE(group.is_group("x"));
  CHECK_THROWS_WITH(group.attribute<std::int64_t>("number"),
                    "cannot read the attribute number of /g: it has another type");
  CHECK_THROWS_WITH(group.attribute<double>("none"),
                    "cannot read the attribute none of /g: it is missing");
  CHECK_THROWS_WITH(group.group("t"), "cannot open the group /g/t: it is not a group");
  CHECK_THROWS_WITH(group.text("t"), "cannot read the text /g/t: it is not a text of fixed length");
  CHECK_THROWS_WITH(group.data("y"), "cannot open /g/y: it is missing");
}

TEST_CASE("A group of many members is read") {  // more than one node of names can hold
  auto file = Hdf5File::create();
  {
    auto root = file.root();
    for (int i = 0; i < 1000; ++i) root.create_group("g" + std::to_string(i));
  }
  const auto image = file.image();
  const auto root = stored_hdf5({image.begin(), image.end()}, 0);
  CHECK(root.names().size() == 1000);
  for (int i = 0; i < 1000; ++i) REQUIRE(root.is_group("g" + std::to_string(i)));
}

TEST_CASE("The checksum of a chunk is that of HDF5") {
  auto bytes = image_of_table(3, false);
  const std::int64_t sixteen = 16;
  const std::string value(reinterpret_cast<const char*>(&sixteen), sizeof sixteen);
  bytes[place_of(bytes, value + std::string("\x19", 1))] ^= 1;  // 16, and 25 behind it
  CHECK(complaint(bytes) == "cannot read the data set /g/t: a checksum is wrong");
}

TEST_CASE("A file of another length than it says is refused") {
  auto bytes = image_of_table(3, false);
  bytes.push_back('\0');
  CHECK(contains(complaint(bytes), "another length"));
  bytes.resize(bytes.size() - 2);
  CHECK(contains(complaint(bytes), "another length"));
  for (std::size_t size = 0; size < 200; ++size) {
    bytes.resize(size);
    CHECK_FALSE(complaint(bytes).empty());
  }
}

TEST_CASE("Trees that bite their own tail are refused") {
  auto bytes = image_of_table(70'001, true);
  const auto leaf_head = std::string("TREE\1\0", 6), root_head = std::string("TREE\1\1", 6);
  const auto root = place_of(bytes, root_head);
  constexpr std::size_t key = 8 + 3 * 8, first_child = 24 + key,
                        second_child = first_child + 8 + key;
  SECTION("a root as its own child") {
    put(bytes, root + first_child, root);
    CHECK(contains(complaint(bytes), "a tree is damaged"));
  }
  SECTION("the same leaf twice") {
    put(bytes, root + second_child, word(bytes, root + first_child));
    CHECK(contains(complaint(bytes), "chunks are out of order"));
  }
  SECTION("the same leaf of names twice") {
    const auto leaf = place_of(bytes, "SNOD", 1);
    const auto entries = word(bytes, leaf + 4) >> 16U & 0xffffU;
    REQUIRE(entries == 2);  // t and x
    std::memcpy(&bytes[leaf + 8 + 40], &bytes[leaf + 8], 8);
    CHECK(contains(complaint(bytes), "names are out of order"));
  }
  SECTION("a leaf without chunks") {
    put(bytes, place_of(bytes, leaf_head) + 6, 0, 2);
    CHECK_FALSE(complaint(bytes).empty());
  }
}

TEST_CASE("Names that lie within each other are refused") {
  auto file = Hdf5File::create();
  constexpr std::size_t members = 8, longest = 60;
  {
    auto root = file.root();
    root.create_group(std::string(longest, 'a'));
    for (char name = 'b'; name < 'a' + static_cast<char>(members); ++name)
      root.create_group(std::string(1, name));
  }
  const auto image = file.image();
  std::vector<char> bytes(image.begin(), image.end());
  const auto entry = [&, leaf = place_of(bytes, "SNOD")](std::size_t i) {
    return leaf + 8 + i * 40;
  };
  const auto first = word(bytes, entry(0));
  REQUIRE(stored_hdf5(bytes, 0).names().size() == members);
  for (std::size_t i = 0; i < members; ++i) put(bytes, entry(i), first + members - 1 - i);
  CHECK(contains(message_of<Hdf5Error>([&] { stored_hdf5(bytes, 0); }), "the names overlap"));
}

TEST_CASE("A file gives a few times what it has, and no more") {
  const auto bytes = image_of_table(1000, false);
  const auto group = stored_hdf5(bytes, 0).group("g");
  const auto table = group.data("t");
  std::vector<std::int64_t> values(2000);
  for (int i = 0; i < 5; ++i) table.read(std::span(values));
  CHECK_THROWS_WITH(
      [&] {
        for (int i = 0; i < 20; ++i) table.read(std::span(values));
      }(),
      Catch::Matchers::Contains("too many places"));
  const auto texts = stored_hdf5(bytes, 0).group("g");
  CHECK_THROWS_WITH(
      [&] {
        for (std::size_t i = 0; i < bytes.size(); ++i) static_cast<void>(texts.text("x"));
      }(),
      Catch::Matchers::Contains("too many places"));
}

TEST_CASE("Sizes that are not in the file are refused before any memory is taken") {
  auto bytes = image_of_table(70'001, true);
  const std::uint64_t rows = 70'001, columns = 2;
  std::string extent(16, '\0');
  std::memcpy(extent.data(), &rows, 8);
  std::memcpy(&extent[8], &columns, 8);
  const auto place = place_of(bytes, extent);
  for (const std::uint64_t many :
       {std::uint64_t{70'657}, std::uint64_t{1} << 40U, ~std::uint64_t{0}}) {
    put(bytes, place, many);
    CHECK_FALSE(complaint(bytes).empty());
  }
  put(bytes, place, rows);
  const auto type = place_of(bytes, std::string("\x10\x08\0\0\x08\0\0\0", 8));
  put(bytes, type, 0x13);  // a text of length 0
  CHECK(contains(complaint(bytes), "it is a text without length"));
  put(bytes, type, 0x8'0000'0810);
  for (const std::uint64_t many : {std::uint64_t{0}, std::uint64_t{1} << 62U, ~std::uint64_t{0}}) {
    put(bytes, place + 8, many);
    CHECK(contains(complaint(bytes), "its size is impossible"));
  }
}
