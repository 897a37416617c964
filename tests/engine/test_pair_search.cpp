// The coarse search errs on the side of a hit, and only by a little.
#include "engine/pair_search.hpp"
#include "tests/catch.hpp"
#include "tests/engine/systems.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

using namespace systems;

namespace {

/// Pairs of grains at a given distance, in random directions and places, half of them astride the
/// seam.
struct Pairs {
  CandidatePairs pairs;
  PackedPositions positions;
};

Pairs pairs_at(double distance, double reach, std::size_t count, const Box& box) {
  Dice dice(1);
  const CoarseUnits units(box);
  Pairs pairs;
  const auto place = [&](double x, double y) {
    pairs.positions.points.emplace_back().set(box.fixed_x(x), box.fixed_y(y));
    return static_cast<std::uint32_t>(pairs.positions.points.size() - 1);
  };
  for (std::size_t p = 0; p < count; ++p) {
    const double angle = dice.between(0.0, 2.0 * std::numbers::pi);
    const double x = dice.between(0.0, box.width);
    const double y =
        p % 2 == 0 ? dice.between(-0.5, 0.5) * distance : dice.between(0.0, box.length);
    const std::uint32_t first = place(x, y);
    const std::uint32_t second =
        place(x + distance * std::cos(angle), y + distance * std::sin(angle));
    pairs.pairs.add(first, second, units.generous_square(reach));
  }
  return pairs;
}

using Indices = std::vector<std::uint32_t>;

/// They must stand in order, each once.
std::size_t count_of(const Indices& found) {
  CHECK(std::is_sorted(found.begin(), found.end()));
  CHECK(std::adjacent_find(found.begin(), found.end()) == found.end());
  return found.size();
}

/// What is there must go.
Indices overlapping(const Pairs& p, const Box& box) {
  Selection found;
  found.add(7);
  find_overlapping(p.pairs, p.positions, CoarseUnits(box), found);
  return {found.items().begin(), found.items().end()};
}

std::size_t hits(const Pairs& p, const Box& box) { return count_of(overlapping(p, box)); }

std::size_t near(const Pairs& p, double skin, const Box& box) {
  Indices found{7, 7, 7};
  find_near(p.pairs, p.positions, CoarseUnits(box), skin, found);
  return count_of(found);
}

/// As pairs in contact are marked.
void mark_all(Pairs& p) {
  for (float& reach2 : p.pairs.reach2) reach2 = -reach2;
}

}  // namespace

TEST_CASE("every pair that overlaps is hit, whatever its number and place") {
  const Box box{.width = 20e-3, .length = GENERATE(3e-3, 0.1, 10.0)};
  const auto count = GENERATE(as<std::size_t>{}, 0, 1, 7, 8, 63, 64, 65, 1000);
  CAPTURE(box.length, count);
  CHECK(hits(pairs_at(1e-3 * (1.0 - 1e-12), 1e-3, count, box), box) == count);
}

TEST_CASE("those pairs are hit that overlap, be they few or many") {
  const Box box{.width = 20e-3, .length = 0.1};
  const auto count = GENERATE(as<std::size_t>{}, 64, 65, 1000);
  const double part = GENERATE(0.01, 0.3, 0.99);
  CAPTURE(count, part);
  Pairs pairs = pairs_at(1e-3, 1.1e-3, count, box);
  Dice dice(3);
  Indices overlap;
  for (std::uint32_t p = 0; p < count; ++p)
    if (dice.between(0.0, 1.0) < part)
      overlap.push_back(p);
    else
      pairs.pairs.reach2[p] = CoarseUnits(box).generous_square(0.9e-3);
  CHECK(overlapping(pairs, box) == overlap);
}

TEST_CASE("no pair beyond the resolution is hit") {
  const Box box{.width = 20e-3, .length = 0.1};
  const CoarseUnits units(box);
  const double resolution = 8.0 * static_cast<double>(units.x + units.y) + 2e-6 * 1e-3;
  CHECK(resolution < 1e-8);
  CHECK(hits(pairs_at(1e-3 + resolution, 1e-3, 1000, box), box) == 0);
}

TEST_CASE("every pair within the skin is near, and none much farther") {
  const Box box{.width = 20e-3, .length = 0.1};
  const auto count = GENERATE(as<std::size_t>{}, 0, 1, 7, 63, 64, 65, 1000);
  const double skin = GENERATE(0.0, 1e-8, 1e-5, 3e-4);
  CAPTURE(count, skin);
  CHECK(near(pairs_at((1e-3 + skin) * (1.0 - 1e-12), 1e-3, count, box), skin, box) == count);
  CHECK(near(pairs_at(1e-3 + skin + 2e-8, 1e-3, count, box), skin, box) == 0);
}

TEST_CASE("pairs in contact are not searched for") {
  const Box box{.width = 20e-3, .length = 0.1};
  Pairs pairs = pairs_at(0.9e-3, 1e-3, 100, box);
  mark_all(pairs);
  CHECK(hits(pairs, box) == 0);
  CHECK(near(pairs, 1e-4, box) == 0);
}

TEST_CASE("a difference of packed positions is that of their upper halves") {
  Dice dice(2);
  const auto up_to = [&](double most) { return static_cast<Fixed>(dice.between(-most, most)); };
  for (int round = 0; round < 1000; ++round) {
    // Along x by up to 1.5 * 2^30 units, to either side of 0; along y by any number.
    const Fixed x = up_to(0x1p61), y = up_to(0x1p63);
    const Fixed other_x = wrapped_sum(x, up_to(0x1.8p62)), other_y = wrapped_sum(y, up_to(0x1p63));
    PackedPoint from, to;
    from.set(x, y);
    to.set(other_x, other_y);
    CHECK(from.point().x == upper_half(x));
    CHECK(from.point().y == upper_half(y));
    const CoarsePoint way = PackedPoint::unpacked(PackedPoint::difference(to, from));
    CHECK(way.x == coarse_difference(upper_half(other_x), upper_half(x)));
    CHECK(way.y == coarse_difference(upper_half(other_y), upper_half(y)));
  }
}
