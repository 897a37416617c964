// The coarse search errs on the side of a hit, and only by a little.
#include "engine/pair_search.hpp"
#include "tests/catch.hpp"
#include "tests/engine/systems.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace systems;

namespace {

/// Pairs of grains at a given distance, in random directions and places, half of them astride the
/// seam.
struct Pairs {
  Slice slice;
  CoarsePositions positions;
};

Pairs pairs_at(double distance, double reach, std::size_t count, const Box& box) {
  Dice dice(1);
  const CoarseUnits units(box);
  Pairs pairs;
  const auto place = [&](double x, double y) {
    pairs.positions.x.push_back(upper_half(box.fixed_x(x)));
    pairs.positions.y.push_back(upper_half(box.fixed_y(y)));
    return static_cast<std::uint32_t>(pairs.positions.x.size() - 1);
  };
  for (std::size_t p = 0; p < count; ++p) {
    const double angle = dice.between(0.0, 2.0 * std::numbers::pi);
    const double x = dice.between(0.0, box.width);
    const double y =
        p % 2 == 0 ? dice.between(-0.5, 0.5) * distance : dice.between(0.0, box.length);
    const std::uint32_t first = place(x, y);
    const std::uint32_t second =
        place(x + distance * std::cos(angle), y + distance * std::sin(angle));
    pairs.slice.pairs.add(first, second, units.generous_square(reach));
  }
  return pairs;
}

std::size_t hits(Pairs pairs, const Box& box) {
  State state;
  state.box = box;
  std::vector<std::uint32_t>& found = pairs.slice.hits;
  found = {7, 7, 7};  // what was there must go
  find_overlapping(pairs.slice, state, pairs.positions, CoarseUnits(box));
  CHECK(std::is_sorted(found.begin(), found.end()));
  CHECK(std::adjacent_find(found.begin(), found.end()) == found.end());
  return found.size();
}

}  // namespace

TEST_CASE("every pair that overlaps is hit, whatever its number and place") {
  const Box box{.width = 20e-3, .length = GENERATE(3e-3, 0.1, 10.0)};
  const auto count = GENERATE(as<std::size_t>{}, 0, 1, 7, 8, 63, 64, 65, 1000);
  CAPTURE(box.length, count);
  CHECK(hits(pairs_at(1e-3 * (1.0 - 1e-12), 1e-3, count, box), box) == count);
}

TEST_CASE("no pair beyond the resolution is hit") {
  const Box box{.width = 20e-3, .length = 0.1};
  const CoarseUnits units(box);
  const double resolution = 8.0 * static_cast<double>(units.x + units.y) + 2e-6 * 1e-3;
  CHECK(resolution < 1e-8);
  CHECK(hits(pairs_at(1e-3 + resolution, 1e-3, 1000, box), box) == 0);
}
