// Several exact sums that grow together: the same bits as so many ExactSum, but added to by vector
// instructions.
//
// For loops over all grains: adding to a 128-bit integer is slow, as the carry goes from word to
// word. Here the quanta of each term are split into three numbers of the same sign, which are
// summed separately and combined at the end.
#pragma once

#include "engine/exact_sum.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace riesel {

template <std::size_t n>
class ExactSums {
public:
  /// Adds terms[i] to sum i, as ExactSum::add() does. At most 2^31 times: the partial sums of 32
  /// bits would leave 64 bits.
  [[gnu::always_inline]] void add(const std::array<double, n>& terms) {
#pragma omp simd
    for (std::size_t i = 0; i < n; ++i) {
      // Exact: a double has 53 bits, and each remainder holds the bits not yet taken.
      const double whole = terms[i] * 0x1p26;
      const auto high = static_cast<std::int64_t>(whole);
      const double rest = (whole - static_cast<double>(high)) * 0x1p32;
      const auto middle = static_cast<std::int64_t>(rest);
      const auto low = static_cast<std::int64_t>((rest - static_cast<double>(middle)) * 0x1p32);
      high_[i] += high;
      middle_[i] += middle;
      low_[i] += low;
    }
  }

  ExactSum sum(std::size_t i) const {
    const Int128 quanta = (static_cast<Int128>(high_[i]) * (Int128{1} << 64))
                          + static_cast<Int128>(middle_[i]) * (Int128{1} << 32) + low_[i];
    return ExactSum::from_halves(static_cast<std::int64_t>(quanta >> 64),
                                 static_cast<std::uint64_t>(quanta));
  }

private:
  std::array<std::int64_t, n> high_{}, middle_{}, low_{};  // in units of 2^-26, 2^-58 and 2^-90
};

}  // namespace riesel
