// When a run that asks for precision may stop: at the looks, if the last two of them please.

#include "engine/stopping_rule.hpp"

#include "engine/steady_state.hpp"
#include "tests/catch.hpp"

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <random>
#include <span>
#include <stdexcept>
#include <vector>

namespace {

using Series = std::vector<double>;

/// Of a flow whose other series is the same.
bool is_precise(std::span<const double> series, double relative_error,
                std::optional<double> free_fall_gain = {}) {
  return riesel::is_precise(
      {.judged = series, .free_fall_gain = free_fall_gain, .others = {series}}, relative_error);
}

/// 1 with white noise of standard deviation `noise`.
Series steady(std::size_t n, double noise, unsigned seed) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal(1.0, noise);
  Series series(n);
  for (double& sample : series) sample = normal(generator);
  return series;
}

double relative_error(std::span<const double> series) {
  const riesel::SteadyState state = riesel::assess_steady_state(series);
  return state.error / state.mean;
}

std::vector<std::size_t> looks_up_to(std::size_t most) {
  std::vector<std::size_t> looks;
  for (std::size_t n = 0; n <= most; ++n)
    if (riesel::is_time_to_look(n)) looks.push_back(n);
  return looks;
}

}  // namespace

TEST_CASE("a run is looked at each time it is a quarter longer", "[stopping_rule]") {
  CHECK(looks_up_to(600) == std::vector<std::size_t>{100, 125, 156, 195, 243, 303, 378, 472, 590});
}

TEST_CASE("a run is precise at looks only, and at no first one", "[stopping_rule]") {
  CHECK_FALSE(is_precise(Series(125, 0.0), 0.01));  // nothing has been measured
  const Series constant(600, 2.0);
  std::vector<std::size_t> precise;
  for (std::size_t n = 0; n <= constant.size(); ++n)
    if (is_precise(std::span(constant).first(n), 0.01)) precise.push_back(n);
  CHECK(precise == std::vector<std::size_t>{125, 156, 195, 243, 303, 378, 472, 590});
}

TEST_CASE("both looks must be as precise as is asked for", "[stopping_rule]") {
  const Series series = steady(590, 0.3, 1);
  const double now = relative_error(series);
  const double before = relative_error(std::span(series).first(472));
  const double worse = std::max(now, before);
  REQUIRE(std::min(now, before) < 0.99 * worse);
  CHECK(is_precise(series, 1.001 * worse));
  CHECK_FALSE(is_precise(series, 0.999 * worse));
}

TEST_CASE("either of the two errors may be the one that is too large", "[stopping_rule]") {
  int now_is_worse = 0, before_is_worse = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Series series = steady(590, 0.3, seed);
    const double now = relative_error(series);
    const double before = relative_error(std::span(series).first(472));
    (now > before ? now_is_worse : before_is_worse) += 1;
    CHECK_FALSE(is_precise(series, 0.999 * std::max(now, before)));
  }
  CHECK(now_is_worse > 0);
  CHECK(before_is_worse > 0);
}

TEST_CASE("a mean that is no steady one is never precise", "[stopping_rule]") {
  Series falling(590);
  for (std::size_t i = 0; i < falling.size(); ++i) falling[i] = 100.0 + static_cast<double>(i);
  CHECK_FALSE(is_precise(falling, 1.0));
  CHECK_FALSE(is_precise(falling, 1.0, 1.0));
}

TEST_CASE("a flow that falls in the end is never precise, however well its mean is known",
          "[stopping_rule]") {
  // The last 85 samples: too short a fall for a trend of the whole.
  const double gain = 0.01;
  const std::size_t held = 505;
  int precise = 0, of_falls = 0, of_steady = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    Series series = steady(590, 0.3, seed);
    of_steady += is_precise(series, 1.0, gain);
    for (std::size_t i = held; i < series.size(); ++i)
      series[i] += gain * static_cast<double>(i - held);
    precise += is_precise(series, 1.0);
    of_falls += is_precise(series, 1.0, gain);
  }
  CHECK(of_steady >= 15);
  CHECK(precise >= 18);
  CHECK(of_falls == 0);
}

TEST_CASE("the precision is relative to the mean, of either sign", "[stopping_rule]") {
  Series series = steady(590, 0.3, 2);
  const double error =
      1.001 * std::max(relative_error(series), relative_error(std::span(series).first(472)));
  CHECK(is_precise(series, error));
  for (double& sample : series) sample *= -5.0;
  CHECK(is_precise(series, error));
  for (double& sample : series) sample += 5.0;  // now about zero
  CHECK_FALSE(is_precise(series, 1.0));
}

TEST_CASE("a sample that is not finite is refused by the rule", "[stopping_rule]") {
  Series series(125, 1.0);
  series[7] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(is_precise(series, 0.1), std::invalid_argument);
}

TEST_CASE("a flow whose other series drifts is never precise", "[stopping_rule]") {
  const Series series = steady(590, 0.3, 3);
  Series cooling = steady(590, 0.03, 4);
  CHECK(riesel::is_precise({series, {}, {cooling}}, 1.0));
  for (std::size_t i = 0; i < cooling.size(); ++i) cooling[i] -= 1e-3 * static_cast<double>(i);
  CHECK_FALSE(riesel::is_precise({series, {}, {cooling}}, 1.0));
}
