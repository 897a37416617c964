#include "engine/time_blocks.hpp"

#include "engine/require.hpp"

#include <bit>
#include <utility>

namespace riesel {

TimeBlocks::TimeBlocks(std::size_t columns, std::int64_t samples, std::int64_t samples_per_block,
                       std::vector<double> sums)
    : columns_(columns),
      samples_(samples),
      samples_per_block_(samples_per_block),
      sums_(std::move(sums)) {
  require(samples >= 0, "the number of samples is negative");
  require(samples_per_block > 0
              && std::has_single_bit(static_cast<std::uint64_t>(samples_per_block)),
          "the length of a block is no power of two");
  require(size() < most, "there are too many blocks");
  const std::size_t begun = size() + (samples % samples_per_block > 0 ? 1 : 0);
  require(begun == 0 ? sums_.empty() : sums_.size() % begun == 0 && sums_.size() / begun == columns,
          "the blocks are not as many as the samples say");
}

void TimeBlocks::add(std::span<const double> sample) {
  require(sample.size() == columns_, "a sample of another number of values");
  if (samples_ % samples_per_block_ == 0) sums_.resize(sums_.size() + columns_);
  double* block = sums_.data() + (sums_.size() - columns_);
  for (std::size_t i = 0; i < columns_; ++i) block[i] += sample[i];
  ++samples_;
  if (size() == most) merge_pairs();
}

void TimeBlocks::merge_pairs() {
  for (std::size_t block = 0; block < most / 2; ++block)
    for (std::size_t i = 0; i < columns_; ++i)
      sums_[block * columns_ + i] =
          sums_[2 * block * columns_ + i] + sums_[(2 * block + 1) * columns_ + i];
  sums_.resize(most / 2 * columns_);
  samples_per_block_ *= 2;
}

std::vector<double> TimeBlocks::means(std::size_t column, std::int64_t first) const {
  const auto length = static_cast<double>(samples_per_block_);
  const auto begin =
      static_cast<std::size_t>((first + samples_per_block_ - 1) / samples_per_block_);
  std::vector<double> means;
  for (std::size_t block = begin; block < size(); ++block)
    means.push_back(sums_[block * columns_ + column] / length);
  return means;
}

}  // namespace riesel
