// Sums that come out the same in any order, and are as accurate as their terms.
#include "engine/exact_sum.hpp"

#include "engine/exact_sums.hpp"
#include "tests/catch.hpp"
#include "tests/engine/systems.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

using riesel::ExactSum;
using systems::Dice;

namespace {

/// Terms of both signs over 15 decades, as energies of grains have them.
std::vector<double> terms(std::size_t n) {
  Dice dice(1);
  std::vector<double> values(n);
  for (double& value : values)
    value = std::pow(10.0, dice.between(-14.0, 1.0)) * (dice.below(2) == 0 ? 1.0 : -1.0);
  return values;
}

ExactSum sum_of(const std::vector<double>& values) {
  ExactSum sum;
  for (const double value : values) sum.add(value);
  return sum;
}

}  // namespace

TEST_CASE("a sum does not depend on the order of its terms") {
  std::vector<double> values = terms(1000);
  const ExactSum sum = sum_of(values);
  std::reverse(values.begin(), values.end());
  CHECK(sum_of(values) == sum);
  std::sort(values.begin(), values.end());
  CHECK(sum_of(values) == sum);
}

TEST_CASE("a sum does not depend on how its terms are shared") {
  const std::vector<double> values = terms(999);
  std::array<ExactSum, 3> shares;
  ExactSum total;
  for (std::size_t i = 0; i < values.size(); ++i) shares[i % 3].add(values[i]);
  for (const ExactSum& share : shares) total.add(share);
  CHECK(total == sum_of(values));
}

TEST_CASE("a sum loses less than its resolution per term") {
  // against long double, which carries 64 bits: 1000 terms below 10 give 1e-15 at most
  const std::vector<double> values = terms(1000);
  long double reference = 0.0L;
  for (const double value : values) reference += static_cast<long double>(value);
  CHECK(std::abs(sum_of(values).value() - static_cast<double>(reference)) < 1e-14);
  CHECK(sum_of({1e-20, 1e10, -1e10}).value() == Approx(1e-20).epsilon(1e-7));
}

TEST_CASE("sums that grow together are those that grow alone, bit by bit") {
  std::vector<double> values = terms(1000);
  const double denormal = std::numeric_limits<double>::denorm_min();
  const std::vector<double> special = {0.0,     -0.0,    1e10,    -1e10,     0.9e11,
                                       -0.9e11, 0x1p-26, 0x1p-27, -0x1p-58,  0x1p-90,
                                       0x1p-91, 1e-300,  -1e-300, -denormal, 1.0 + 0x1p-52};
  values.insert(values.end(), special.begin(), special.end());
  riesel::ExactSums<3> together;
  std::array<ExactSum, 3> alone;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::array<double, 3> of_this = {values[i], -values[i], values[values.size() - 1 - i]};
    together.add(of_this);
    for (std::size_t k = 0; k < 3; ++k) {
      alone[k].add(of_this[k]);
      REQUIRE(together.sum(k) == alone[k]);
    }
  }
}

TEST_CASE("terms that cancel leave nothing") {
  std::vector<double> values = terms(500);
  for (std::size_t i = 0, n = values.size(); i < n; ++i) values.push_back(-values[i]);
  CHECK(sum_of(values) == ExactSum{});
  CHECK(sum_of(values).value() == 0.0);
}

TEST_CASE("a term is rounded towards zero to a multiple of 2^-90") {
  std::vector<double> values = terms(1000);
  for (const double value : {0.0, -0.0, 0x1p-90, 0x1.fffffffffffffp-90, 0x1p-91, 0x1p-143, 0x1p-144,
                             5e-324, 1.0, 0x1.fffffffffffffp36, 9.9e10})
    for (const double signed_value : {value, -value}) values.push_back(signed_value);
  for (const double value : values) {
    const auto expected = static_cast<riesel::Int128>(value * 0x1p90);
    const ExactSum sum = sum_of({value});
    CHECK(sum.high() == static_cast<std::int64_t>(expected >> 64));
    CHECK(sum.low() == static_cast<std::uint64_t>(expected));
  }
}

TEST_CASE("the two halves hold all of a sum") {
  for (const double value : {0.0, 1e-27, -1e-27, 1.0, -1.0, 3e10, -3e10, 0.1}) {
    const ExactSum sum = sum_of({value, value});
    CHECK(ExactSum::from_halves(sum.high(), sum.low()) == sum);
  }
}
