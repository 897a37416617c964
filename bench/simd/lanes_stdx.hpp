// std::experimental::simd, the vectors of the second Parallelism TS, which come with GCC. They have
// no gathers: lanes are loaded one by one.
#pragma once

#include <experimental/simd>

#include <bit>
#include <cstddef>
#include <cstdint>

namespace riesel::bench::simd {

namespace {

namespace stdx = std::experimental;

struct Lanes {
  using Reals = stdx::native_simd<double>;
  using Words = stdx::native_simd<std::uint64_t>;
  using Floats = stdx::native_simd<float>;
  static constexpr std::size_t reals = Reals::size(), floats = Floats::size();

  static Floats all(float value) { return value; }
  static Reals all(double value) { return value; }
  static Words all(std::uint64_t value) { return value; }

  static Floats load(const float* from) { return {from, stdx::element_aligned}; }
  static Reals load(const double* from) { return {from, stdx::element_aligned}; }
  static void store(double* to, Reals value) { value.copy_to(to, stdx::element_aligned); }
  static void store(std::int64_t* to, Words value) { value.copy_to(to, stdx::element_aligned); }

  static Words gather(const std::int64_t* from, const std::int64_t* at) {
    return Words([&](auto lane) { return static_cast<std::uint64_t>(from[at[lane]]); });
  }
  static Floats coarse_difference(const std::int32_t* from, const std::uint32_t* a,
                                  const std::uint32_t* b) {
    using Coarse = stdx::rebind_simd_t<std::uint32_t, Floats>;
    const auto gathered = [&](const std::uint32_t* at) {
      return Coarse([&](auto lane) { return static_cast<std::uint32_t>(from[at[lane]]); });
    };
    using Signed = stdx::rebind_simd_t<std::int32_t, Floats>;
    const auto difference = stdx::static_simd_cast<Signed>(gathered(a) - gathered(b));
    return stdx::static_simd_cast<Floats>(difference);
  }

  static Reals as_reals(Words bits) { return std::bit_cast<Reals>(bits); }
  static Words as_words(Reals value) { return std::bit_cast<Words>(value); }
  template <int bits>
  static Words shift_left(Words value) {
    return value << bits;
  }
  template <int bits>
  static Words shift_right(Words value) {
    return value >> bits;
  }

  static Reals root(Reals value) { return stdx::sqrt(value); }
  static Reals size(Reals value) { return stdx::abs(value); }
  static Reals negative(Reals value) { return -value; }
  static Reals choose(Reals::mask_type mask, Reals yes, Reals no) {
    stdx::where(mask, no) = yes;
    return no;
  }
  static std::uint64_t bits(Floats::mask_type mask) {
    std::uint64_t result = 0;
    if (stdx::none_of(mask)) return result;
    for (std::size_t lane = 0; lane < floats; ++lane)
      result |= static_cast<std::uint64_t>(mask[lane]) << lane;
    return result;
  }
};

}  // namespace

}  // namespace riesel::bench::simd
