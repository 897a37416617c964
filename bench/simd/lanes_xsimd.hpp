// xsimd. Its version 8 gathers with one instruction for AVX2, lane by lane for AVX-512.
#pragma once

#include <xsimd/xsimd.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace riesel::bench::simd {

namespace {

struct Lanes {
  using Reals = xsimd::batch<double>;
  using Words = xsimd::batch<std::uint64_t>;
  using Signed = xsimd::batch<std::int64_t>;
  using Floats = xsimd::batch<float>;
  using Coarse = xsimd::batch<std::int32_t>;
  static constexpr std::size_t reals = Reals::size, floats = Floats::size;

  static Floats all(float value) { return Floats::broadcast(value); }
  static Reals all(double value) { return Reals::broadcast(value); }
  static Words all(std::uint64_t value) { return Words::broadcast(value); }

  static Floats load(const float* from) { return Floats::load_unaligned(from); }
  static Reals load(const double* from) { return Reals::load_unaligned(from); }
  static void store(double* to, Reals value) { value.store_unaligned(to); }
  static void store(std::int64_t* to, Words value) {
    xsimd::bitwise_cast<Signed>(value).store_unaligned(to);
  }

  static Words gather(const std::int64_t* from, const std::int64_t* at) {
    return xsimd::bitwise_cast<Words>(Signed::gather(from, Signed::load_unaligned(at)));
  }
  static Floats coarse_difference(const std::int32_t* from, const std::uint32_t* a,
                                  const std::uint32_t* b) {
    const auto gathered = [&](const std::uint32_t* at) {
      const auto index =
          xsimd::bitwise_cast<Coarse>(xsimd::batch<std::uint32_t>::load_unaligned(at));
      return Coarse::gather(from, index);
    };
    return xsimd::to_float(gathered(a) - gathered(b));
  }

  static Reals as_reals(Words bits) { return xsimd::bitwise_cast<Reals>(bits); }
  static Words as_words(Reals value) { return xsimd::bitwise_cast<Words>(value); }
  template <int bits>
  static Words shift_left(Words value) {
    return value << bits;
  }
  template <int bits>
  static Words shift_right(Words value) {
    return value >> bits;
  }

  static Reals root(Reals value) { return xsimd::sqrt(value); }
  static Reals size(Reals value) { return xsimd::abs(value); }
  static Reals negative(Reals value) { return -value; }
  static Reals choose(Reals::batch_bool_type mask, Reals yes, Reals no) {
    return xsimd::select(mask, yes, no);
  }
  static std::uint64_t bits(Floats::batch_bool_type mask) {
    std::uint64_t result = 0;
    if (!xsimd::any(mask)) return result;
    std::array<bool, floats> hit{};
    mask.store_unaligned(hit.data());
    for (std::size_t lane = 0; lane < floats; ++lane)
      result |= static_cast<std::uint64_t>(hit[lane]) << lane;
    return result;
  }
};

}  // namespace

}  // namespace riesel::bench::simd
