// Highway, for the instructions that the compiler was told of; its choice at run time is left out.
#pragma once

#include <hwy/highway.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace riesel::bench::simd {

namespace {

namespace hn = hwy::HWY_NAMESPACE;

struct Lanes {
  using RealTag = hn::ScalableTag<double>;
  using WordTag = hn::ScalableTag<std::uint64_t>;
  using SignedTag = hn::ScalableTag<std::int64_t>;
  using FloatTag = hn::ScalableTag<float>;
  using CoarseTag = hn::ScalableTag<std::int32_t>;
  using Reals = hn::Vec<RealTag>;
  using Words = hn::Vec<WordTag>;
  using Floats = hn::Vec<FloatTag>;
  static constexpr std::size_t reals = HWY_MAX_BYTES / sizeof(double);
  static constexpr std::size_t floats = HWY_MAX_BYTES / sizeof(float);

  static Floats all(float value) { return hn::Set(FloatTag{}, value); }
  static Reals all(double value) { return hn::Set(RealTag{}, value); }
  static Words all(std::uint64_t value) { return hn::Set(WordTag{}, value); }

  static Floats load(const float* from) { return hn::LoadU(FloatTag{}, from); }
  static Reals load(const double* from) { return hn::LoadU(RealTag{}, from); }
  static void store(double* to, Reals value) { hn::StoreU(value, RealTag{}, to); }
  static void store(std::int64_t* to, Words value) {
    hn::StoreU(hn::BitCast(SignedTag{}, value), SignedTag{}, to);
  }

  static Words gather(const std::int64_t* from, const std::int64_t* at) {
    const SignedTag tag;
    return hn::BitCast(WordTag{}, hn::GatherIndex(tag, from, hn::LoadU(tag, at)));
  }
  static Floats coarse_difference(const std::int32_t* from, const std::uint32_t* a,
                                  const std::uint32_t* b) {
    const CoarseTag tag;
    const auto gathered = [&](const std::uint32_t* at) {
      const auto index = hn::LoadU(hn::ScalableTag<std::uint32_t>{}, at);
      return hn::GatherIndex(tag, from, hn::BitCast(tag, index));
    };
    return hn::ConvertTo(FloatTag{}, gathered(a) - gathered(b));
  }

  static Reals as_reals(Words bits) { return hn::BitCast(RealTag{}, bits); }
  static Words as_words(Reals value) { return hn::BitCast(WordTag{}, value); }
  template <int bits>
  static Words shift_left(Words value) {
    return hn::ShiftLeft<bits>(value);
  }
  template <int bits>
  static Words shift_right(Words value) {
    return hn::ShiftRight<bits>(value);
  }

  static Reals root(Reals value) { return hn::Sqrt(value); }
  static Reals size(Reals value) { return hn::Abs(value); }
  static Reals negative(Reals value) { return hn::Neg(value); }
  static Reals choose(hn::Mask<RealTag> mask, Reals yes, Reals no) {
    return hn::IfThenElse(mask, yes, no);
  }
  static std::uint64_t bits(hn::Mask<FloatTag> mask) {
    const FloatTag tag;
    if (hn::AllFalse(tag, mask)) return 0;
    std::array<std::uint8_t, 8> bytes{};  // StoreMaskBits may write 8
    hn::StoreMaskBits(tag, mask, bytes.data());
    return bytes[0] | static_cast<std::uint64_t>(bytes[1]) << 8U;
  }
};

}  // namespace

}  // namespace riesel::bench::simd
