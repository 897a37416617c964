// The histograms of a tally with error bars: how often contacts and visits of each kind came.
//
// Contacts come in bunches (a cluster at the wall, a burst on the way), so that the error of a
// count is larger than its square root. What ended between two samples is counted in blocks of
// time, like the sums of the profiles. The errors are taken from the slowest variations of these
// counts (estimate_mean), and so include bunches and correlations.
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
  /// Restores the object that had these blocks. Throws std::invalid_argument if they have another
  /// number of columns.
  explicit HistogramBlocks(TimeBlocks blocks);

  /// Adds a sample: what has ended since the last one. `tally` is that since step 0.
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
