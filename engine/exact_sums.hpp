// Several exact sums that grow together: the same as so many ExactSum, bit by bit, but added to by
// vector instructions.
//
// For loops over all grains: a sum over 128 bits is slow to add to, as the carry goes from word to
// word. Here the quanta of each term are three numbers of the same sign, which are summed apart and
// put together in the end.
#pragma once

#include "engine/exact_sum.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace riesel {

template <std::size_t n>
class ExactSums {
public:
  /// Adds a term to each sum, as ExactSum::add() does. For at most 2^31 terms.
  [[gnu::always_inline]] void add(const std::array<double, n>& terms) {
#pragma omp simd
    for (std::size_t i = 0; i < n; ++i) {
      // Exact: a double has 53 bits, and what is cut off has those that are left.
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
  std::array<std::int64_t, n> high_{}, middle_{}, low_{};  // of 2^-26, 2^-58 and 2^-90
};

}  // namespace riesel
