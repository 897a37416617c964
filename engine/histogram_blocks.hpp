// The histograms of a tally with error bars: how often contacts and visits of each kind came.
//
// Contacts come in bunches (a cluster at the wall, a burst on the way), so that the square root of
// a count is less than its error. What ended between two samples is counted in blocks of time, like
// the sums of the profiles, and the errors come from the slowest motions of these counts
// (estimate_mean), which know of bunches and of correlations.
#pragma once

#include "engine/estimate.hpp"
#include "engine/tally.hpp"
#include "engine/time_blocks.hpp"

#include <cstdint>
#include <string_view>
#include <vector>

namespace riesel {

/// One histogram of a tally.
struct HistogramTable {
  std::string_view name, unit, meaning;
  std::vector<double> lower_edges;   ///< of the bins, in `unit`
  std::vector<std::int64_t> counts;  ///< since step 0
  std::vector<Estimate> rates;       ///< 1/s, after a transient
};

class HistogramBlocks {
public:
  HistogramBlocks();
  /// As it was when these were its blocks. Throws std::invalid_argument if they cannot be.
  explicit HistogramBlocks(TimeBlocks blocks);

  /// A sample: what has ended since the last one.
  void add(const Tally& tally);

  const TimeBlocks& blocks() const { return blocks_; }

private:
  TimeBlocks blocks_;
  std::vector<double> seen_;  // counts of all samples
};

/// All histograms of `tally`. The rates are of the complete blocks that begin after sample `first`;
/// `interval` (s) lies between two samples. Without such a block they are not known.
std::vector<HistogramTable> histogram_tables(const Tally& tally, const TimeBlocks& blocks,
                                             std::int64_t first, double interval);

}  // namespace riesel
