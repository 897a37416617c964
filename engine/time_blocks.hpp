// Many values sampled at even intervals, kept as sums over blocks of time.
//
// A mean over the steady part of a run, with an error bar that includes correlations, needs a
// series of values; but for some hundred values the whole series is too long to keep. The error is
// taken from the slowest variations of a series (engine/time_series.hpp), which blocks show as well
// as samples do. There are never more than `most` blocks: when all are complete, pairs of blocks
// become one, and later blocks are twice as long. So the memory is bounded however long the run is,
// and the blocks depend on the samples alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace riesel {

class TimeBlocks {
public:
  /// Half of them are left when pairs have become one: enough for an error bar, which needs 20,
  /// unless the transient took more than two thirds of the run.
  static constexpr std::size_t most = 128;

  TimeBlocks() = default;
  /// For samples of `columns` values.
  explicit TimeBlocks(std::size_t columns) : columns_(columns) {}

  /// Restores an object from its contents. Throws std::invalid_argument if no object can have
  /// these.
  TimeBlocks(std::size_t columns, std::int64_t samples, std::int64_t samples_per_block,
             std::vector<double> sums);

  /// Adds one sample of columns() finite values. Throws std::invalid_argument for another number of
  /// values.
  void add(std::span<const double> sample);

  std::size_t columns() const { return columns_; }
  std::int64_t samples() const { return samples_; }
  std::int64_t samples_per_block() const { return samples_per_block_; }
  /// Complete blocks.
  std::size_t size() const { return static_cast<std::size_t>(samples_ / samples_per_block_); }

  /// The means of one column over the complete blocks that begin at sample `first` or later.
  std::vector<double> means(std::size_t column, std::int64_t first) const;

  /// Block by block, `columns` sums for each; the last one may be incomplete. For files.
  const std::vector<double>& sums() const { return sums_; }

private:
  void merge_pairs();

  std::size_t columns_ = 0;
  std::int64_t samples_ = 0;
  std::int64_t samples_per_block_ = 1;
  std::vector<double> sums_;
};

}  // namespace riesel
