// Random numbers without a state: each is a function of (seed, use, whose, draw).
//
// Philox4x32-10 (Salmon et al., SC11) from Random123. Nothing has to be stored in checkpoints, any
// order of drawing gives the same numbers, and two uses never share one.
#pragma once

#include <array>
#include <cstdint>

namespace riesel {

/// What a number is used for. The streams of different uses of one seed are independent.
enum class Use : std::uint32_t { radius = 1, vacancy = 2, velocity = 3 };

class RandomStream {
public:
  RandomStream(std::uint64_t seed, Use use);

  /// Two independent numbers, uniform in (0, 1). `whose` is the grain or site that they are for,
  /// `draw` counts the draws for it.
  std::array<double, 2> uniform(std::uint64_t whose, std::uint32_t draw = 0) const;
  /// Two independent normal numbers with mean 0 and variance 1 (Box and Muller).
  std::array<double, 2> normal(std::uint64_t whose, std::uint32_t draw = 0) const;

private:
  std::uint64_t seed_;
  std::uint32_t use_;
};

}  // namespace riesel
