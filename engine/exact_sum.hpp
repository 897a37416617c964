// Sums that come out the same in any order.
//
// Each term is rounded once, to a multiple of 2^-90 of its unit; the sum of the multiples is a
// 128-bit integer and exact. So a number reported of many grains or contacts does not depend on how
// the threads shared them. Range: |sum| < 1e11 units, resolution 8e-28 units: with SI values of
// grains (energies of 1e-15 ... 1e3 J) both ends are far away.
#pragma once

#include <cstdint>

namespace riesel {

__extension__ using Int128 = __int128;

class ExactSum {
public:
  /// Adds a finite term, |term| < 1e11.
  void add(double term) { quanta_ += static_cast<Int128>(term * quanta_per_unit); }
  void add(const ExactSum& other) { quanta_ += other.quanta_; }
  /// Adds another sum `times` over.
  void add(const ExactSum& other, std::int64_t times) { quanta_ += other.quanta_ * times; }

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
  static constexpr double quanta_per_unit = 0x1p90;
  static constexpr double unit_per_quantum = 0x1p-90;
  Int128 quanta_ = 0;
};

}  // namespace riesel
