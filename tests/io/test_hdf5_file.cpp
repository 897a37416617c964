// What HDF5's library cannot do is told in one line, with its reasons.
#include "io/hdf5_file.hpp"

#include "tests/io/file_fixture.hpp"

#include <span>
#include <vector>

using namespace riesel::io;
using namespace file_fixture;

TEST_CASE("A failed call of HDF5 says what was attempted, and HDF5's reasons") {
  silence_hdf5();
  const ScratchDirectory directory;
  const auto none = message_of<Hdf5Error>([&] { Hdf5File::open(directory / "none.h5"); });
  CHECK(none.starts_with("cannot open "));
  CHECK(contains(none, "No such file or directory"));
  CHECK_FALSE(contains(none, "\n"));

  auto file = Hdf5File::create();
  auto root = file.root();
  root.create_group("g");
  CHECK(contains(message_of<Hdf5Error>([&] { root.create_group("g"); }), "name already exists"));
  CHECK(message_of<Hdf5Error>([&] { root.group("h"); }).starts_with("cannot open the group /h: "));
}

TEST_CASE("What has another shape than asked for is refused") {
  auto file = Hdf5File::create();
  auto root = file.root();
  root.set_attribute("text", "no number");
  root.set_attribute("number", 1.0);
  auto data = root.create_data<double>("d", {.rows = 2});
  const std::vector<double> three(3);
  CHECK(contains(message_of<Hdf5Error>([&] { data.write(std::span(three)); }),
                 "the size does not match"));
  CHECK(contains(message_of<Hdf5Error>([&] { (void)root.text_attribute("number"); }),
                 "it is not a text of fixed length"));
  CHECK_THROWS_AS(root.attribute<double>("text"), Hdf5Error);
}
