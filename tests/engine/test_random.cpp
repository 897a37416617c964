// Random numbers: those of Philox, a function of their arguments and of nothing else, and well
// distributed.
#include "engine/random.hpp"
#include "tests/catch.hpp"

#include <Random123/philox.h>

#include <array>
#include <cmath>
#include <set>

using namespace riesel;

namespace {

constexpr int many = 100000;

/// Mean and variance over many grains, two numbers each.
template <class Draw>
std::array<double, 2> moments(Draw draw) {
  double sum = 0.0, squares = 0.0;
  for (std::uint64_t whose = 0; whose < many; ++whose)
    for (const double value : draw(whose)) {
      sum += value;
      squares += value * value;
    }
  const double mean = sum / (2.0 * many);
  return {mean, squares / (2.0 * many) - mean * mean};
}

}  // namespace

TEST_CASE("the generator is Philox4x32-10") {
  // Known answers of Random123's own test (kat_vectors): counter and key of zeros, of ones, of pi.
  using Philox = r123::Philox4x32;
  const auto zeros = Philox()({{0, 0, 0, 0}}, {{0, 0}});
  CHECK(zeros[0] == 0x6627e8d5u);
  CHECK(zeros[1] == 0xe169c58du);
  CHECK(zeros[2] == 0xbc57ac4cu);
  CHECK(zeros[3] == 0x9b00dbd8u);
  const auto pi = Philox()({{0x243f6a88u, 0x85a308d3u, 0x13198a2eu, 0x03707344u}},
                           {{0xa4093822u, 0x299f31d0u}});
  CHECK(pi[0] == 0xd16cfe09u);
  CHECK(pi[1] == 0x94fdccebu);
  CHECK(pi[2] == 0x5001e420u);
  CHECK(pi[3] == 0x24126ea1u);
}

TEST_CASE("a uniform number is made of the bits of its own counter") {
  // seed in the key; whose, draw and use in the counter; 53 of 64 bits, in the middle of their
  // interval
  const std::uint64_t seed = 0x0123456789abcdefu, whose = 0xfedcba9876543210u;
  const auto bits =
      r123::Philox4x32()({{0x76543210u, 0xfedcba98u, 7u, 2u}}, {{0x89abcdefu, 0x01234567u}});
  const auto [u, v] = RandomStream(seed, Use::vacancy).uniform(whose, 7);
  const auto fraction = [](std::uint32_t high, std::uint32_t low) {
    return std::ldexp(static_cast<double>(high), -32) + std::ldexp(static_cast<double>(low), -64);
  };
  CHECK(std::abs(u - fraction(bits[0], bits[1])) < 2e-16);
  CHECK(std::abs(v - fraction(bits[2], bits[3])) < 2e-16);
}

TEST_CASE("numbers do not depend on the order in which they are drawn") {
  const RandomStream stream(1, Use::velocity);
  const auto first = stream.uniform(5);
  for (std::uint64_t whose = 0; whose < 10; ++whose) (void)stream.uniform(whose, 3);
  CHECK(stream.uniform(5) == first);
  CHECK(RandomStream(1, Use::velocity).uniform(5) == first);
}

TEST_CASE("seeds, uses, owners and draws never share a number") {
  std::set<double> seen;
  for (const std::uint64_t seed : {1u, 2u})
    for (const Use use : {Use::radius, Use::vacancy, Use::velocity})
      for (const std::uint64_t whose : {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{1} << 32})
        for (const std::uint32_t draw : {0u, 1u})
          for (const double value : RandomStream(seed, use).uniform(whose, draw))
            seen.insert(value);
  CHECK(seen.size() == 72);  // seeds, uses, owners, draws, two each
}

TEST_CASE("uniform numbers are uniform in (0, 1)") {
  const RandomStream stream(42, Use::radius);
  std::array<int, 20> histogram{};
  const auto [mean, variance] = moments([&](std::uint64_t whose) {
    const auto pair = stream.uniform(whose);
    for (const double value : pair) {
      REQUIRE(value > 0.0);
      REQUIRE(value < 1.0);
      ++histogram[static_cast<std::size_t>(20.0 * value)];
    }
    return pair;
  });
  // Standard errors with 2e5 numbers: 6.5e-4 of the mean, 1.7e-4 of the variance, 97 of a bin. Five
  // of them.
  CHECK(std::abs(mean - 0.5) < 3.3e-3);
  CHECK(std::abs(variance - 1.0 / 12.0) < 8.5e-4);
  for (const int count : histogram) CHECK(std::abs(count - many / 10) < 490);
}

TEST_CASE("normal numbers have mean 0 and variance 1, and are independent within a pair") {
  const RandomStream stream(42, Use::velocity);
  const auto [mean, variance] = moments([&](std::uint64_t whose) { return stream.normal(whose); });
  double product = 0.0;
  int beyond_two = 0;
  for (std::uint64_t whose = 0; whose < many; ++whose) {
    const auto [a, b] = stream.normal(whose);
    product += a * b / many;
    beyond_two += std::abs(a) > 2.0;
  }
  // Standard errors: 2.2e-3, 3.2e-3, 3.2e-3; 4.55 % lie beyond two sigma, 66 of them uncertain.
  // Five of each.
  CHECK(std::abs(mean) < 1.1e-2);
  CHECK(std::abs(variance - 1.0) < 1.6e-2);
  CHECK(std::abs(product) < 1.6e-2);
  CHECK(std::abs(beyond_two - 4550) < 330);
}
