// Positions and velocities as 64-bit integers: kinematics without rounding.
//
// A coordinate is an integer multiple of a tiny length quantum, a velocity is the integer number of
// quanta covered in one time step. Both choices buy the same thing: additions are exact and
// therefore associative. The order in which contacts are found or summed, the number of threads,
// the sorting of the store, a checkpoint in between, and whether a grain in free flight crosses K
// steps one by one or at once can none of them change a bit. Along the periodic axis the period is
// 2^64 quanta, so that wrapping round the seam and the nearest image are what integer overflow does
// by itself.
//
// Signed overflow is undefined in C++, so the sums go through unsigned integers, where it is not.
#pragma once

#include <cstdint>

namespace riesel {

/// A coordinate, or a displacement per time step, in quanta of its axis.
using Fixed = std::int64_t;

/// 2^-64: the length quantum of an axis is its range times this.
inline constexpr double two_to_minus_64 = 0x1p-64;

constexpr Fixed wrapped_sum(Fixed a, Fixed b) {
  return static_cast<Fixed>(static_cast<std::uint64_t>(a) + static_cast<std::uint64_t>(b));
}

constexpr Fixed wrapped_difference(Fixed a, Fixed b) {
  return static_cast<Fixed>(static_cast<std::uint64_t>(a) - static_cast<std::uint64_t>(b));
}

constexpr Fixed wrapped_product(Fixed a, Fixed b) {
  return static_cast<Fixed>(static_cast<std::uint64_t>(a) * static_cast<std::uint64_t>(b));
}

/// The upper half of a coordinate: what the search for neighbours looks at.
constexpr std::int32_t upper_half(Fixed a) { return static_cast<std::int32_t>(a >> 32); }

/// Nearest integer to `quanta` (ties to even); |quanta| must be below 2^63.
inline Fixed nearest_fixed(double quanta) { return static_cast<Fixed>(__builtin_llrint(quanta)); }

}  // namespace riesel
