// The wall grains near a place follow from arithmetic: none is forgotten, none comes twice.
#include "engine/wall_lattice.hpp"
#include "tests/catch.hpp"
#include "tests/engine/systems.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

using namespace systems;

namespace {

const Box box{.width = 10e-3, .length = 13.2e-3};

std::vector<std::int64_t> near(const WallLattice& wall, double y, double reach) {
  std::vector<std::int64_t> found;
  for_each_wall_grain_within(wall, box, box.fixed_y(y), reach, [&](std::int64_t k, Fixed place) {
    found.push_back(k);
    CHECK(place == wall.place(k));
  });
  return found;
}

}  // namespace

TEST_CASE("the wall grains within reach are those of brute force") {
  const auto count = GENERATE(as<std::int64_t>{}, 1, 2, 3, 4, 20, 20000);
  const WallLattice wall{.line = 0.0, .radius = wall_radius, .count = count};
  CAPTURE(count);
  Dice dice(1);
  for (int trial = 0; trial < 60; ++trial) {
    const double y = trial < 6 ? (trial - 3) * 1e-9 : dice.between(-box.length, 2.0 * box.length);
    const double reach = dice.between(0.0, 2e-3);
    CAPTURE(y, reach);
    const std::vector<std::int64_t> found = near(wall, y, reach);

    CHECK(std::is_sorted(found.begin(), found.end()));
    CHECK(std::adjacent_find(found.begin(), found.end()) == found.end());
    std::int64_t missing = 0;
    for (std::int64_t k = 0; k < count; ++k) {
      const double place = static_cast<double>(k) * box.length / static_cast<double>(count);
      if (std::abs(std::remainder(y - place, box.length)) < reach)
        missing += !std::binary_search(found.begin(), found.end(), k);
    }
    CHECK(missing == 0);
    // "a few more": two beyond what the reach covers
    const double covered = 2.0 * reach / wall.spacing(box);
    CHECK(static_cast<double>(found.size()) <= covered + 3.0);
    CHECK(std::all_of(found.begin(), found.end(),
                      [&](std::int64_t k) { return 0 <= k && k < count; }));
  }
}

TEST_CASE("the neighbours of a place at the seam are on both sides of it") {
  const WallLattice wall{.line = 0.0, .radius = wall_radius, .count = 20};  // every 0.66 mm
  CHECK(near(wall, 1e-6, 0.7e-3) == std::vector<std::int64_t>{0, 1, 2, 19});
  CHECK(near(wall, -1e-6, 0.7e-3) == std::vector<std::int64_t>{0, 1, 18, 19});
}

TEST_CASE("a reach longer than the period gives every wall grain once") {
  const WallLattice wall{.line = 0.0, .radius = wall_radius, .count = 3};
  CHECK(near(wall, 5e-3, 1.0) == std::vector<std::int64_t>{0, 1, 2});
}

TEST_CASE("wall grains near each other have bits of their own, at the seam, too") {
  for (std::int64_t count = 1; count <= 600; ++count) {
    const WallLattice wall{.line = 0.0, .radius = wall_radius, .count = count};
    std::int64_t shared = 0;
    for (std::int64_t k = 0; k < count; ++k)
      for (std::int64_t apart = 1; apart <= WallLattice::most_told_apart; ++apart)
        shared += apart % count != 0 && wall.bit_of(k) == wall.bit_of((k + apart) % count);
    CAPTURE(count);
    REQUIRE(shared == 0);
  }
}

TEST_CASE("wall grains stand evenly, the first at the seam") {
  const auto count = GENERATE(as<std::int64_t>{}, 1, 3, 7, 1000000);
  const WallLattice wall{.line = 0.0, .radius = wall_radius, .count = count};
  CHECK(wall.place(0) == 0);
  CHECK(wall.spacing(box) == box.length / static_cast<double>(count));
  for (const std::int64_t k : {count / 3, count / 2, count - 1}) {
    const double exact = static_cast<double>(k) * wall.spacing(box);
    CHECK(std::abs(std::remainder(box.place_y(wall.place(k)) - exact, box.length)) < 1e-15);
  }
}
