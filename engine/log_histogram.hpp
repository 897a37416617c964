// A histogram of positive values over many orders of magnitude, with bins about a fifth of the
// value wide.
//
// Four bins make an octave and are equally wide within it: 1 to 1.25, 1.5, 1.75 and 2 times a power
// of two. They are found from the bits of the number, without logarithm and rounding. Counts can be
// merged in any order.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>

namespace riesel {

/// 28 octaves from 2^lowest of the unit upwards; what lies beyond is counted in the first or the
/// last bin.
template <int lowest>
class LogHistogram {
public:
  static constexpr std::size_t bins = 112;
  using Counts = std::array<std::int64_t, bins>;

  void add(double value) { ++counts_[bin_of(value)]; }
  void merge(const LogHistogram& other) {
    std::transform(counts_.begin(), counts_.end(), other.counts_.begin(), counts_.begin(),
                   std::plus<>());
  }

  const Counts& counts() const { return counts_; }
  Counts& counts() { return counts_; }
  std::int64_t total() const {
    return std::accumulate(counts_.begin(), counts_.end(), std::int64_t{0});
  }

  /// The lower edge of a bin: 1, 1.25, 1.5 or 1.75 times a power of two.
  static double lower_edge(std::size_t bin) {
    return std::bit_cast<double>((first_quarter + bin) << bits_below_a_quarter);
  }

  /// The lower edge of the bin of the quantile: the value below which this part of all values lies,
  /// 0 <= part < 1. 0 if that is the first bin, which also holds all smaller values, or if there
  /// are no values.
  double quantile(double part) const {
    const double wanted = part * static_cast<double>(total());
    double below = 0.0;
    for (std::size_t bin = 0; bin < bins; ++bin) {
      below += static_cast<double>(counts_[bin]);
      if (below > wanted) return bin > 0 ? lower_edge(bin) : 0.0;
    }
    return 0.0;
  }

  bool operator==(const LogHistogram&) const = default;

private:
  // The bits of a positive double, read as an integer, grow with its value; all but the upper two
  // bits of the mantissa are cut off. The exponent of 1 is stored as 1023.
  static constexpr int bits_below_a_quarter = 50;
  static constexpr std::uint64_t first_quarter = std::uint64_t{4} * (1023 + lowest);

  static std::size_t bin_of(double value) {
    if (!(value > lower_edge(0))) return 0;
    const std::uint64_t quarter = std::bit_cast<std::uint64_t>(value) >> bits_below_a_quarter;
    return static_cast<std::size_t>(std::min<std::uint64_t>(quarter - first_quarter, bins - 1));
  }

  Counts counts_{};
};

using DurationHistogram = LogHistogram<-30>;  ///< s, from a nanosecond to a quarter of a second
using OverlapHistogram = LogHistogram<-28>;   ///< parts of the sum of the radii, up to all of it
using SpeedHistogram = LogHistogram<-20>;     ///< m/s, from 1e-6 to 256

}  // namespace riesel
