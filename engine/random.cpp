#include "engine/random.hpp"

#include <Random123/philox.h>

#include <cmath>
#include <numbers>

namespace riesel {

namespace {

/// The middle of one of 2^52 equal parts of (0, 1), which a double holds exactly; 52 of the 64
/// random bits tell which.
double open_unit(std::uint32_t high, std::uint32_t low) {
  const std::uint64_t bits = ((static_cast<std::uint64_t>(high) << 32) | low) >> 12;
  return (static_cast<double>(bits) + 0.5) * 0x1p-52;
}

}  // namespace

RandomStream::RandomStream(std::uint64_t seed, Use use)
    : seed_(seed), use_(static_cast<std::uint32_t>(use)) {}

std::array<double, 2> RandomStream::uniform(std::uint64_t whose, std::uint32_t draw) const {
  const r123::Philox4x32::ctr_type counter = {
      {static_cast<std::uint32_t>(whose), static_cast<std::uint32_t>(whose >> 32), draw, use_}};
  const r123::Philox4x32::key_type key = {
      {static_cast<std::uint32_t>(seed_), static_cast<std::uint32_t>(seed_ >> 32)}};
  const auto bits = r123::Philox4x32()(counter, key);
  return {open_unit(bits[0], bits[1]), open_unit(bits[2], bits[3])};
}

std::array<double, 2> RandomStream::normal(std::uint64_t whose, std::uint32_t draw) const {
  const auto [u, v] = uniform(whose, draw);
  const double r = std::sqrt(-2.0 * std::log(u));
  const double angle = 2.0 * std::numbers::pi * v;
  return {r * std::cos(angle), r * std::sin(angle)};
}

}  // namespace riesel
