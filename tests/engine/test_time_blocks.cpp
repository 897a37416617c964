// Blocks of time: sums of what was sampled, however long, and the same after any interruption.
#include "engine/time_blocks.hpp"
#include "tests/catch.hpp"

#include <array>
#include <limits>
#include <stdexcept>

using namespace riesel;

namespace {

/// Integers, so that sums are exact in any order.
std::array<double, 2> sample(std::int64_t i) {
  return {static_cast<double>(i), static_cast<double>(i * i % 17)};
}

TimeBlocks blocks_of(std::int64_t samples) {
  TimeBlocks blocks(2);
  for (std::int64_t i = 0; i < samples; ++i) blocks.add(sample(i));
  return blocks;
}

}  // namespace

TEST_CASE("blocks hold the means of their samples, never more than so many") {
  for (const std::int64_t samples : {0, 1, 127, 128, 129, 255, 256, 1000, 5000}) {
    CAPTURE(samples);
    const TimeBlocks blocks = blocks_of(samples);
    const std::int64_t length = blocks.samples_per_block();
    CHECK(blocks.samples() == samples);
    CHECK(blocks.size() < TimeBlocks::most);
    if (length > 1) CHECK(blocks.size() >= TimeBlocks::most / 2);
    CHECK(blocks.size() == static_cast<std::size_t>(samples / length));
    for (std::size_t column = 0; column < 2; ++column) {
      const auto means = blocks.means(column, 0);
      REQUIRE(means.size() == blocks.size());
      for (std::size_t b = 0; b < means.size(); ++b) {
        double sum = 0.0;
        const auto first = static_cast<std::int64_t>(b) * length;
        for (std::int64_t i = first; i < first + length; ++i) sum += sample(i)[column];
        REQUIRE(means[b] == sum / static_cast<double>(length));
      }
    }
  }
}

TEST_CASE("what comes after a transient are the blocks that begin after it") {
  const TimeBlocks blocks = blocks_of(300);  // blocks of four
  REQUIRE(blocks.samples_per_block() == 4);
  REQUIRE(blocks.size() == 75);
  for (const auto& [first, left] :
       {std::pair{0, 75}, {1, 74}, {4, 74}, {5, 73}, {296, 1}, {297, 0}})
    CHECK(blocks.means(0, first).size() == static_cast<std::size_t>(left));
  CHECK(blocks.means(0, 5).front() == 9.5);  // of 8, 9, 10, 11
}

TEST_CASE("blocks go on from their contents as if nothing had happened") {
  for (const std::int64_t interruption : {0, 1, 100, 127, 128, 131, 700, 999}) {
    const TimeBlocks before = blocks_of(interruption);
    TimeBlocks after(before.columns(), before.samples(), before.samples_per_block(), before.sums());
    for (std::int64_t i = interruption; i < 1000; ++i) after.add(sample(i));
    CHECK(after.sums() == blocks_of(1000).sums());
    CHECK(after.samples() == 1000);
  }
}

TEST_CASE("contents that cannot be are refused") {
  const auto refused = [](std::size_t columns, std::int64_t samples, std::int64_t length,
                          std::size_t sums) {
    CHECK_THROWS_AS(TimeBlocks(columns, samples, length, std::vector<double>(sums)),
                    std::invalid_argument);
  };
  CHECK_NOTHROW(TimeBlocks(3, 5, 2, std::vector<double>(9)));
  refused(3, -1, 1, 0);
  refused(3, 5, 3, 6);
  refused(3, 5, 0, 9);
  refused(3, 5, 2, 6);
  refused(3, 0, 1, 3);
  refused(3, 128, 1, 384);
  refused(std::numeric_limits<std::size_t>::max() / 2 + 1, 2, 1, 0);
}

TEST_CASE("a sample of another number of values is refused") {
  TimeBlocks blocks(2);
  CHECK_THROWS_AS(blocks.add(std::array{1.0}), std::invalid_argument);
}
