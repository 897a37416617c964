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

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>

namespace riesel {

/// A coordinate, or a displacement per time step, in quanta of its axis.
using Fixed = std::int64_t;

/// Both coordinates. They are stored side by side because contacts and courses look up single
/// grains in random order, which then costs one cache line instead of two.
struct FixedVector {
  Fixed x, y;

  friend bool operator==(const FixedVector&, const FixedVector&) = default;
};

/// The length quantum of an axis is its range times this.
inline constexpr double two_to_minus_64 = 0x1p-64;

/// rad, the quantum of angles: a whole turn is 2^64 of them.
inline constexpr double quantum_of_angle = 2.0 * std::numbers::pi * two_to_minus_64;

constexpr Fixed wrapped_sum(Fixed a, Fixed b) {
  return static_cast<Fixed>(static_cast<std::uint64_t>(a) + static_cast<std::uint64_t>(b));
}

constexpr Fixed wrapped_difference(Fixed a, Fixed b) {
  return static_cast<Fixed>(static_cast<std::uint64_t>(a) - static_cast<std::uint64_t>(b));
}

constexpr Fixed wrapped_product(Fixed a, Fixed b) {
  return static_cast<Fixed>(static_cast<std::uint64_t>(a) * static_cast<std::uint64_t>(b));
}

constexpr FixedVector wrapped_sum(FixedVector a, FixedVector b) {
  return {wrapped_sum(a.x, b.x), wrapped_sum(a.y, b.y)};
}

constexpr FixedVector wrapped_difference(FixedVector a, FixedVector b) {
  return {wrapped_difference(a.x, b.x), wrapped_difference(a.y, b.y)};
}

constexpr FixedVector wrapped_product(Fixed a, FixedVector b) {
  return {wrapped_product(a, b.x), wrapped_product(a, b.y)};
}

/// Both coordinates in one register; sums wrap round. By itself GCC 12 takes a FixedVector apart as
/// soon as it is to be converted to doubles.
using Lanes = std::uint64_t __attribute__((vector_size(sizeof(FixedVector))));

[[gnu::always_inline]] inline Lanes lanes_of(const FixedVector& v) {
  Lanes lanes;
  std::memcpy(&lanes, &v, sizeof(lanes));  // std::bit_cast would go by way of memory
  return lanes;
}

[[gnu::always_inline]] inline void put(Lanes lanes, FixedVector& to) {
  std::memcpy(&to, &lanes, sizeof(to));
}

/// The upper half of a coordinate: what the search for neighbours looks at.
constexpr std::int32_t upper_half(Fixed a) { return static_cast<std::int32_t>(a >> 32); }

/// The lowest coordinate with this upper half.
constexpr Fixed from_upper(std::int32_t upper) {
  return static_cast<Fixed>(static_cast<std::uint64_t>(upper) << 32);
}

/// floor(parts * y / period), exact: which of `parts` equal parts of the ring holds y, counted from
/// y = 0. `parts` > 0.
constexpr std::int64_t part_of_ring(Fixed y, std::int64_t parts) {
  __extension__ using Wide = unsigned __int128;
  return static_cast<std::int64_t>(
      (static_cast<Wide>(static_cast<std::uint64_t>(y)) * static_cast<Wide>(parts)) >> 64);
}

/// Nearest integer to `quanta` (ties to even), as llrint() gives it; |quanta| must be below 2^63.
/// Uses only additions, which vectorise everywhere: adding 1.5 * 2^52 leaves no bits for a
/// fraction and so rounds. This is done first to the upper part of the number, then to the rest.
[[gnu::always_inline]] inline Fixed nearest_fixed(double quanta) {
  constexpr double shift = 0x1.8p52;
  const auto integer = [=](double shifted) {
    return wrapped_difference(std::bit_cast<Fixed>(shifted), std::bit_cast<Fixed>(shift));
  };
  const double upper = quanta * 0x1p-26 + shift;
  const double lower = quanta - (upper - shift) * 0x1p26 + shift;
  return wrapped_sum(wrapped_product(integer(upper), Fixed{1} << 26), integer(lower));
}

/// `quanta` rounded to an integer (ties to even). A double beyond 2^52 is an integer already; there
/// the result may be a neighbouring multiple of 2, 4 and so on.
[[gnu::always_inline]] inline double rounded(double quanta) {
  const double shift = std::copysign(0x1p52, quanta);  // away from zero: so the sum is whole
  return (quanta + shift) - shift;
}

/// Converts between integers and doubles by the processor's own instructions, which exist for
/// vectors only from AVX-512 on.
struct ByConversion {
  /// The nearest double.
  [[gnu::always_inline]] static double real(Fixed a) { return static_cast<double>(a); }
  /// rounded(quanta). Beyond 2^63, or for NaN, the result is an arbitrary integer (as on x86): the
  /// caller must detect that.
  [[gnu::always_inline]] static Fixed whole(double quanta) {
    return static_cast<Fixed>(rounded(quanta));
  }
};

/// Gives the same bits by additions, which vectorise everywhere.
struct ByAddition {
  /// Each 32-bit half becomes the mantissa of a double whose exponent (2^84 or 2^52) gives its last
  /// bit the value 2^32 or 1; subtracting the offsets leaves the sum of the halves.
  [[gnu::always_inline]] static double real(Fixed a) {
    constexpr double upper_origin = 0x1p84, lower_origin = 0x1p52, sign = 0x1p63;
    const auto bits = static_cast<std::uint64_t>(a);
    const auto upper = std::bit_cast<double>((bits >> 32) ^ std::uint64_t{0x4530000080000000});
    const auto lower =
        std::bit_cast<double>((bits & 0xffffffffU) | std::uint64_t{0x4330000000000000});
    return (upper - (upper_origin + sign + lower_origin)) + lower;
  }
  [[gnu::always_inline]] static Fixed whole(double quanta) {
    return nearest_fixed(rounded(quanta));
  }
};

/// The nearest double, outside of vector loops.
[[gnu::always_inline]] inline double real(Fixed a) { return ByConversion::real(a); }

/// (since + 1) + (since + 2) + ... + now: the factor of the fall per step^2 in the displacement
/// from step `since` to `now`, for velocities in the frame that falls since step 0. 0 <= since <=
/// now < 2^62. Exact modulo 2^64.
[[gnu::always_inline]] inline std::int64_t sum_of_steps(std::int64_t since, std::int64_t now) {
  // Half the product of two numbers, one of which is even: the even one is halved.
  const auto steps = static_cast<std::uint64_t>(now - since);
  const auto ends = static_cast<std::uint64_t>(since + 1 + now);
  return static_cast<std::int64_t>(steps % 2 == 0 ? steps / 2 * ends : ends / 2 * steps);
}

/// Displacement in quanta from step `since` to `now` of a body in free flight. `u` is its
/// displacement per step in the frame that falls since step 0, `fall` the fall per step^2. Steps as
/// in sum_of_steps().
[[gnu::always_inline]] inline FixedVector way_of_flight(FixedVector u, FixedVector fall,
                                                        std::int64_t since, std::int64_t now) {
  return wrapped_sum(wrapped_product(now - since, u),
                     wrapped_product(sum_of_steps(since, now), fall));
}

}  // namespace riesel
