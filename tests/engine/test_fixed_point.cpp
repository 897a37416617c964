// The conversions that vectorise are the same as those of the processor.
#include "engine/fixed_point.hpp"
#include "tests/catch.hpp"
#include "tests/engine/systems.hpp"

#include <algorithm>
#include <cmath>

using namespace systems;

TEST_CASE("nearest_fixed rounds as llrint does") {
  for (const double x :
       {0.0, -0.0, 0.5, 1.5, 2.5, -0.5, -1.5, 0x1p26 + 0.5, 0x1p26 - 0.5, 3 * 0x1p25 + 0.5,
        0x1p51 + 0.5, 0x1p52 - 0.5, 0x1p53 + 2.0, 0x1p62, -0x1p62})
    CHECK(nearest_fixed(x) == std::llrint(x));
  Dice dice(3);
  for (int k = 0; k < 100'000; ++k) {
    const double x = dice.between(-1.0, 1.0) * std::exp2(dice.between(-3.0, 62.9));
    if (nearest_fixed(x) != std::llrint(x)) FAIL(x);
  }
}

TEST_CASE("additions make the same doubles of integers as instructions do") {
  for (const Fixed x : {Fixed{0}, Fixed{1}, Fixed{-1}, INT64_MAX, INT64_MIN, Fixed{1} << 53,
                        (Fixed{1} << 53) + 1, (Fixed{1} << 54) + 2, -(Fixed{1} << 60) - 129})
    CHECK(ByAddition::real(x) == ByConversion::real(x));
  Dice dice(4);
  for (int k = 0; k < 100'000; ++k) {
    const Fixed x = nearest_fixed(dice.between(-1.0, 1.0) * std::exp2(dice.between(0.0, 62.9)))
                    + dice.below(1000);
    if (ByAddition::real(x) != ByConversion::real(x)) FAIL(x);
  }
}

TEST_CASE(
    "additions make the same integers of doubles as instructions do, the nearest up to 2^52") {
  for (const double x : {0.0, 0.5, 1.5, 2.5, -0.5, -1.5, 0x1p51 + 0.5, 0x1p52 - 0.5, 0.5 - 0x1p52})
    CHECK(ByConversion::whole(x) == std::llrint(x));
  Dice dice(5);
  for (int k = 0; k < 100'000; ++k) {
    const double x = dice.between(-1.0, 1.0) * std::exp2(dice.between(-3.0, 62.9));
    const Fixed whole = ByConversion::whole(x);
    if (ByAddition::whole(x) != whole) FAIL(x);
    if (std::abs(static_cast<double>(whole) - x) > std::max(0.5, 0x1p-52 * std::abs(x))) FAIL(x);
  }
}

TEST_CASE("the fall of many steps is that of single ones") {
  std::int64_t sum = 0;
  for (std::int64_t step = 8; step <= 20; ++step) {
    CHECK(sum_of_steps(7, step - 1) == sum);
    sum += step;
  }
  constexpr std::int64_t late = std::int64_t{1} << 60;
  CHECK(sum_of_steps(late, late + 3) == 3 * late + 6);
  CHECK(sum_of_steps(late + 1, late + 5) == 4 * late + 14);
}
