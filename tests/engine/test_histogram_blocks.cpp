// Histograms with error bars: nothing is lost between two samples, and the bars keep their word
// where contacts come in bunches.
#include "engine/histogram_blocks.hpp"
#include "tests/catch.hpp"
#include "tests/engine/systems.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

using namespace systems;

namespace {

const HistogramTable& find(const std::vector<HistogramTable>& tables, std::string_view name) {
  const auto found = std::ranges::find(tables, name, &HistogramTable::name);
  REQUIRE(found != tables.end());
  return *found;
}

/// The bin of the duration `seconds`.
std::size_t bin_of(double seconds) {
  DurationHistogram one;
  one.add(seconds);
  return static_cast<std::size_t>(std::ranges::find(one.counts(), 1) - one.counts().begin());
}

constexpr double duration = 1e-4;  // s, of the contacts that are counted here

/// A tally to which contacts between grains come at a mean rate of one in five samples, in bunches
/// of so many.
class Bunches {
public:
  Bunches(int size, std::uint64_t seed) : size_(size), dice_(seed) {}

  const Tally& next() {
    if (dice_.between(0.0, 1.0) < rate / size_)
      for (int i = 0; i < size_; ++i) tally_.grains.durations.add(duration);
    return tally_;
  }

  static constexpr double rate = 0.2;  // per sample

private:
  int size_;
  Dice dice_;
  Tally tally_;
};

}  // namespace

TEST_CASE("what ended after the transient is counted, and nothing else") {
  HistogramBlocks blocks;
  Tally tally;
  const auto sample = [&](int samples, int contacts) {
    for (int i = 0; i < samples; ++i) {
      for (int c = 0; c < contacts; ++c) tally.walls.durations.add(duration);
      blocks.add(tally);
    }
  };
  blocks.add(tally);  // the row of the start
  sample(29, 7);
  sample(40, 2);
  const double interval = 0.5;  // s
  const auto all = histogram_tables(tally, blocks.blocks(), 29, interval);
  const HistogramTable& durations = find(all, "wall_contact_duration");
  const std::size_t bin = bin_of(duration);
  CHECK(durations.lower_edges[bin] <= duration);
  CHECK(duration < durations.lower_edges[bin + 1]);
  CHECK(durations.counts[bin] == 29 * 7 + 40 * 2);
  CHECK(durations.rates[bin].value == Approx(2.0 / interval));
  CHECK(durations.rates[bin].error == Approx(0.0).margin(1e-12));
  CHECK(durations.rates[bin + 1].value == 0.0);
  CHECK(find(all, "grain_contact_duration").rates[bin].value == 0.0);
  CHECK(std::isnan(
      find(histogram_tables(tally, blocks.blocks(), 1000, interval), "wall_contact_duration")
          .rates[bin]
          .value));
}

TEST_CASE("each histogram is the one that its name says") {
  // Of the first one value comes in each sample, of the second two, ...
  constexpr int samples = 30;
  constexpr double value = 1e-3;
  HistogramBlocks blocks;
  Tally tally;
  blocks.add(tally);
  for (int sample = 0; sample < samples; ++sample) {
    int times = 0;
    const auto add = [&](auto& histogram) {
      ++times;
      for (int i = 0; i < times; ++i) histogram.add(value);
    };
    add(tally.grains.durations);
    add(tally.grains.overlaps);
    add(tally.walls.durations);
    add(tally.walls.overlaps);
    add(tally.visits.entry_rates);
    add(tally.visits.entry_slips);
    blocks.add(tally);
  }
  const auto all = histogram_tables(tally, blocks.blocks(), 0, 1.0);
  REQUIRE(all.size() == 6);
  std::int64_t times = 0;
  const auto check = [&](std::string_view name, std::string_view unit, double lowest) {
    const HistogramTable& table = find(all, name);
    ++times;
    CAPTURE(std::string(name));
    CHECK(table.unit == unit);
    CHECK(table.lower_edges.front() == lowest);
    const auto after = std::ranges::upper_bound(table.lower_edges, value);
    const auto bin = static_cast<std::size_t>(after - table.lower_edges.begin()) - 1;
    CHECK(table.counts[bin] == times * samples);
    CHECK(table.rates[bin].value == Approx(static_cast<double>(times)));
  };
  check("grain_contact_duration", "s", 0x1p-30);
  check("grain_contact_overlap", "1", 0x1p-28);
  check("wall_contact_duration", "s", 0x1p-30);
  check("wall_contact_overlap", "1", 0x1p-28);
  check("wall_visit_entry_rate", "m/s", 0x1p-20);
  check("wall_visit_entry_slip", "m/s", 0x1p-20);
}

TEST_CASE("overlaps are counted as parts of the sum of the radii") {
  Tally tally;
  Contact contact{.name = {no_wall, 0, 1}};
  contact.max_overlap = 1e-5;
  tally.end(contact, 1e-3);
  contact.max_overlap = 4e-5;
  tally.end(contact, 0.8e-3);
  contact.name = {0, 0, 0};
  tally.end(contact, 0.5e-3);
  OverlapHistogram grains, walls;
  for (const double part : {0.01, 0.05}) grains.add(part);
  walls.add(0.08);
  CHECK(tally.grains.overlaps == grains);
  CHECK(tally.walls.overlaps == walls);
}

TEST_CASE("blocks that were kept go on as if nothing had been") {
  Bunches bunches(3, 5);
  HistogramBlocks through, stopped;
  for (int i = 0; i < 1000; ++i) {
    const Tally& tally = bunches.next();
    through.add(tally);
    stopped.add(tally);
    if (i % 77 == 0) {
      const TimeBlocks& b = stopped.blocks();
      stopped =
          HistogramBlocks(TimeBlocks(b.columns(), b.samples(), b.samples_per_block(), b.sums()));
    }
  }
  CHECK(stopped.blocks().sums() == through.blocks().sums());
  CHECK_THROWS_AS(HistogramBlocks(TimeBlocks(3)), std::invalid_argument);
}

TEST_CASE("the error of a bin without counts is the rate that leaves it empty in 32 % of cases") {
  HistogramBlocks blocks;
  constexpr double interval = 0.5;  // s
  constexpr int samples = 30;
  for (int i = 0; i <= samples; ++i) blocks.add({});
  const auto all = histogram_tables({}, blocks.blocks(), 0, interval);
  const Estimate& rate = find(all, "grain_contact_duration").rates[bin_of(duration)];
  CHECK(rate.value == 0.0);
  CHECK(std::exp(-rate.error * samples * interval) == Approx(0.317).epsilon(0.01));
}

TEST_CASE("the error bars of histograms cover the truth, also where contacts come in bunches") {
  const int size = GENERATE(1, 10);
  constexpr int runs = 200, samples = 2000;
  const std::size_t bin = bin_of(duration);
  int covered = 0, covered_by_root = 0;
  for (int run = 0; run < runs; ++run) {
    Bunches bunches(size, 100 + static_cast<std::uint64_t>(run));
    HistogramBlocks blocks;
    blocks.add({});
    for (int i = 0; i < samples; ++i) blocks.add(bunches.next());
    const auto all = histogram_tables(bunches.next(), blocks.blocks(), 0, 1.0);
    const Estimate& rate = find(all, "grain_contact_duration").rates[bin];
    const double off = std::abs(rate.value - Bunches::rate);
    covered += off < rate.error ? 1 : 0;
    covered_by_root += off < std::sqrt(rate.value / samples) ? 1 : 0;
  }
  CAPTURE(size, covered, covered_by_root);
  CHECK(covered > 0.60 * runs);
  CHECK(covered < 0.80 * runs);
  if (size > 1) CHECK(covered_by_root < 0.40 * runs);  // what the blocks are for
}
