// The grid: sorting changes the slots and nothing else, and the ranges of later partners hold every
// close pair exactly once, for any number of rows and columns.
#include "engine/cells.hpp"
#include "tests/catch.hpp"
#include "tests/engine/systems.hpp"

#include <map>
#include <utility>

using namespace systems;

namespace {

/// Points: the grid does not look at radii.
State scattered(double width, double length, std::size_t grains, std::uint64_t seed) {
  State state = empty_box(10e-3, length);
  Dice dice(seed);
  for (std::size_t i = 0; i < grains; ++i)
    add_grain(state, grain(dice.between(0.0, width), dice.between(-length, length),
                           dice.between(-1.0, 1.0), dice.between(-1.0, 1.0)));
  return state;
}

using Pair = std::pair<std::size_t, std::size_t>;

void sort_alone(Cells& cells, State& state, double range) {
  TeamBarrier alone(1);
  cells.sort(state, range, alone, 0);
}

/// How often each unordered pair of slots comes up.
std::map<Pair, int> visited_pairs(const Cells& cells, std::size_t grains) {
  std::map<Pair, int> visits;
  for (std::size_t i = 0; i < grains; ++i)
    cells.for_each_later_range(i, [&](SlotRange range) {
      for (std::size_t j = range.begin; j < range.end; ++j) ++visits[std::minmax(i, j)];
    });
  return visits;
}

double distance(const State& state, std::size_t i, std::size_t j) {
  const Grain a = grain_at(state, i), b = grain_at(state, j);
  return std::hypot(a.x - b.x, std::remainder(a.y - b.y, state.box.length));
}

/// By cells that may have been used before.
void check_pairs(State state, double range, Cells cells = {}) {
  sort_alone(cells, state, range);
  const std::size_t n = state.grains.size();
  const std::map<Pair, int> visits = visited_pairs(cells, n);
  for (const auto& [pair, times] : visits) {
    CHECK(times == 1);
    CHECK(pair.first != pair.second);
    CHECK(pair.second < n);
  }
  int close = 0;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j)
      if (distance(state, i, j) < range) {
        ++close;
        if (!visits.contains({i, j})) FAIL("a close pair is missing");
      }
  CHECK(close > 0);
}

}  // namespace

TEST_CASE("every close pair comes up exactly once, for any number of rows and columns") {
  const double range = 1e-3;
  // rows of at least one range: 1, 1, 2, 2, 3, 4, 20
  const double length = GENERATE(1.5e-3, 1.99e-3, 2.01e-3, 2.9e-3, 3.5e-3, 4.0e-3, 20.5e-3);
  const double width = GENERATE(0.2e-3, 1.5e-3, 2.5e-3, 7.3e-3);  // 1, 1, 2 and 7 columns
  CAPTURE(length, width);
  check_pairs(scattered(width, length, 120, 1), range);
}

TEST_CASE("all grains in one place are one cell") {
  State state = empty_box(10e-3, 10e-3);
  for (int i = 0; i < 5; ++i) add_grain(state, grain(3e-3, 3e-3, 0.0, 0.0));
  check_pairs(state, 1e-3);
}

TEST_CASE("a single grain has no partners") {
  State state = empty_box(10e-3, 10e-3);
  add_grain(state, grain(3e-3, 3e-3, 0.0, 0.0));
  Cells cells;
  sort_alone(cells, state, 1e-3);
  CHECK(visited_pairs(cells, 1).empty());
}

TEST_CASE("sorting changes the slots and not the grains") {
  const State before = scattered(7e-3, 20e-3, 200, 2);
  State after = before;
  Cells cells;
  sort_alone(cells, after, 1e-3);
  CHECK(state_hash(after) == state_hash(before));
  CHECK(after.grains.id != before.grains.id);
}

TEST_CASE("sorting what is sorted changes nothing") {
  State once = scattered(7e-3, 20e-3, 200, 3);
  Cells cells;
  sort_alone(cells, once, 1e-3);
  State twice = once;
  sort_alone(cells, twice, 1e-3);
  CHECK(twice.grains.id == once.grains.id);
}

TEST_CASE("a grid that is used again forgets the grains it had") {
  Cells cells;
  State many = scattered(7e-3, 20e-3, 200, 4);
  sort_alone(cells, many, 1e-3);
  check_pairs(scattered(7e-3, 5e-3, 20, 5), 1e-3, cells);
}
