// Sums that come out the same in any order.
//
// Each term is rounded once, to a multiple of 2^-90 of its unit; the sum of the multiples is a
// 128-bit integer and exact. So a number reported of many grains or contacts does not depend on how
// the threads shared them. Range: |sum| < 2^37 = 1.4e11 units, resolution 8e-28 units: far from the
// SI values of grains (energies of 1e-15 ... 1e3 J) at both ends, but not from those of boulders.
// Callers must keep sums below largest_sum: nothing here detects an overflow.
#pragma once

#include <bit>
#include <cstdint>

namespace riesel {

__extension__ using Int128 = __int128;

class ExactSum {
public:
  /// Half of the range, in units: the bound that runs check their sums against.
  static constexpr double largest_sum = 0x1p36;

  /// Adds a finite term, |term| < 1e11.
  void add(double term) { quanta_ += quanta(term); }
  void add(const ExactSum& other) { quanta_ += other.quanta_; }

  double value() const { return static_cast<double>(quanta_) * unit_per_quantum; }

  /// The exact content, for files: upper and lower 64 bits of the two's complement.
  std::int64_t high() const { return static_cast<std::int64_t>(quanta_ >> 64); }
  std::uint64_t low() const { return static_cast<std::uint64_t>(quanta_); }
  static ExactSum from_halves(std::int64_t high, std::uint64_t low) {
    ExactSum sum;
    sum.quanta_ = (static_cast<Int128>(high) << 64) | static_cast<Int128>(low);
    return sum;
  }

  bool operator==(const ExactSum&) const = default;

private:
  static constexpr int bits_of_fraction = 90;
  static constexpr double unit_per_quantum = 0x1p-90;

  /// term * 2^90 rounded towards zero, read off the bits: the conversion would be a library call.
  static Int128 quanta(double term) {
    constexpr int mantissa_bits = 52, bias = 1023;
    const auto bits = std::bit_cast<std::uint64_t>(term);
    const int exponent = static_cast<int>(bits >> mantissa_bits & 0x7ff) - bias;
    const std::uint64_t leading = std::uint64_t{1} << mantissa_bits;
    const auto mantissa = static_cast<Int128>((bits & (leading - 1)) | leading);
    const int shift = exponent - mantissa_bits + bits_of_fraction;
    const Int128 size = shift >= 0                   ? mantissa << (shift & 127)
                        : shift > -mantissa_bits - 1 ? mantissa >> -shift
                                                     : 0;
    return term < 0.0 ? -size : size;
  }

  Int128 quanta_ = 0;
};

}  // namespace riesel
