#include "engine/histogram_blocks.hpp"

#include "engine/time_series.hpp"

#include <stdexcept>
#include <utility>

namespace riesel {

namespace {

/// Calls visit(name, unit, meaning, histogram) for each histogram of a tally.
template <class Visit>
void for_each_histogram(const Tally& t, Visit visit) {
  visit("grain_contact_duration", "s", "How long contacts between grains last.",
        t.grains.durations);
  visit("grain_contact_overlap", "1",
        "Largest overlap of contacts between grains, over the sum of the radii.",
        t.grains.overlaps);
  visit("wall_contact_duration", "s", "How long contacts of grains with walls last.",
        t.walls.durations);
  visit("wall_contact_overlap", "1",
        "Largest overlap of contacts of grains with walls, over the sum of the radii.",
        t.walls.overlaps);
  visit("wall_visit_entry_rate", "m/s", "Normal velocity at the beginning of visits to walls.",
        t.visits.entry_rates);
  visit("wall_visit_entry_slip", "m/s", "Slip speed at the beginning of visits to walls.",
        t.visits.entry_slips);
}

/// The counts of all histograms, one after the other: the columns of the blocks.
std::vector<double> counts_of(const Tally& tally) {
  std::vector<double> counts;
  for_each_histogram(tally, [&](auto, auto, auto, const auto& histogram) {
    for (const std::int64_t count : histogram.counts())
      counts.push_back(static_cast<double>(count));
  });
  return counts;
}

/// So many independent events are expected where none come in 32 % of cases: exp(-1.15) = 0.32. In
/// bunches of n it is n times as many.
constexpr double expected_of_none = 1.15;

/// Rate of one bin in 1/s, from its column of the blocks. If nothing was counted, its error is that
/// of what comes one by one.
Estimate rate(const TimeBlocks& blocks, std::size_t column, std::int64_t first, double interval) {
  const std::vector<double> means = blocks.means(column, first + 1);
  const Estimate per_sample = mean_with_error(means);
  const double samples =
      static_cast<double>(means.size()) * static_cast<double>(blocks.samples_per_block());
  const double error = per_sample.value == 0.0 ? expected_of_none / samples : per_sample.error;
  return {per_sample.value / interval, error / interval};
}

}  // namespace

HistogramBlocks::HistogramBlocks() : HistogramBlocks(TimeBlocks(counts_of({}).size())) {}

HistogramBlocks::HistogramBlocks(TimeBlocks blocks)
    : blocks_(std::move(blocks)), seen_(counts_of({}).size()) {
  if (blocks_.columns() != seen_.size())
    throw std::invalid_argument("the blocks are not those of the histograms");
  const std::vector<double>& sums = blocks_.sums();
  for (std::size_t i = 0; i < sums.size(); ++i) seen_[i % seen_.size()] += sums[i];
}

void HistogramBlocks::add(const Tally& tally) {
  std::vector<double> now = counts_of(tally), sample(now.size());
  for (std::size_t i = 0; i < now.size(); ++i) sample[i] = now[i] - seen_[i];
  blocks_.add(sample);
  seen_ = std::move(now);
}

std::vector<HistogramTable> histogram_tables(const Tally& tally, const TimeBlocks& blocks,
                                             std::int64_t first, double interval) {
  std::vector<HistogramTable> tables;
  std::size_t column = 0;
  for_each_histogram(tally, [&](auto name, auto unit, auto meaning, const auto& histogram) {
    HistogramTable table{.name = name,
                         .unit = unit,
                         .meaning = meaning,
                         .lower_edges = {},
                         .counts = {histogram.counts().begin(), histogram.counts().end()},
                         .rates = {}};
    for (std::size_t bin = 0; bin < histogram.bins; ++bin) {
      table.lower_edges.push_back(histogram.lower_edge(bin));
      table.rates.push_back(rate(blocks, column++, first, interval));
    }
    tables.push_back(std::move(table));
  });
  return tables;
}

}  // namespace riesel
