// The statistics of one series against what is known of it: exact where the series is simple, and
// on average over many AR(1) series where it is random. The full tables of coverage take minutes
// and come from coverage_of_error_bars.cpp.

#include "engine/time_series.hpp"

#include "tests/catch.hpp"
#include "tests/engine/noise.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using riesel::autoregressive;
using Series = std::vector<double>;

Series line(std::size_t n, double start, double slope) {
  Series series(n);
  for (std::size_t i = 0; i < n; ++i) series[i] = start + slope * static_cast<double>(i);
  return series;
}

double mean_autocorrelation_time(std::size_t n, double phi) {
  constexpr unsigned count = 40;
  double sum = 0.0;
  for (unsigned seed = 0; seed < count; ++seed) {
    sum += riesel::autocorrelation_time(autoregressive(n, phi, seed));
  }
  return sum / count;
}

/// Fraction of stationary series whose mean lies within its error bar.
double coverage(std::size_t n, double phi) {
  constexpr unsigned count = 1000;
  int covered = 0;
  for (unsigned seed = 0; seed < count; ++seed) {
    const riesel::MeanEstimate mean = riesel::estimate_mean(autoregressive(n, phi, seed));
    covered += std::abs(mean.mean) <= mean.error;
  }
  return static_cast<double>(covered) / count;
}

/// Fraction of stationary series that are said to have a trend.
double false_trends(std::size_t n, double phi) {
  constexpr unsigned count = 1000;
  int alarms = 0;
  for (unsigned seed = 0; seed < count; ++seed) {
    alarms += riesel::is_significant(riesel::estimate_trend(autoregressive(n, phi, seed)));
  }
  return static_cast<double>(alarms) / count;
}

}  // namespace

TEST_CASE("a constant series is known exactly", "[time_series]") {
  const Series constant(1000, 0.1);
  const riesel::MeanEstimate mean = riesel::estimate_mean(constant);
  CHECK(mean.mean == 0.1);
  CHECK(mean.error == 0.0);
  CHECK(mean.autocorrelation_time == 1.0);
  CHECK(mean.independent_samples == 1000.0);
  const riesel::TrendEstimate trend = riesel::estimate_trend(constant);
  CHECK(trend.slope == 0.0);
  CHECK(trend.error == 0.0);
  CHECK_FALSE(riesel::is_significant(trend));
  CHECK(riesel::transient_length(constant) == 0);
}

TEST_CASE("rounding is no motion", "[time_series]") {
  Series almost_constant(1000, 3.0);
  for (std::size_t i = 500; i < 1000; ++i) almost_constant[i] = std::nextafter(3.0, 4.0);
  CHECK(riesel::estimate_mean(almost_constant).error == 0.0);
  CHECK_FALSE(riesel::is_significant(riesel::estimate_trend(almost_constant)));
}

TEST_CASE("a straight line is a trend, known exactly", "[time_series]") {
  const riesel::TrendEstimate trend = riesel::estimate_trend(line(500, 7.0, -0.25));
  CHECK(std::abs(trend.slope + 0.25) < 1e-12);
  CHECK(trend.error < 1e-12);
  CHECK(riesel::is_significant(trend));
}

TEST_CASE("samples that are not finite are refused by index", "[time_series]") {
  Series series = autoregressive(100, 0.5, 1);
  series[17] =
      GENERATE(std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
               -std::numeric_limits<double>::infinity());
  CHECK_THROWS_AS(riesel::transient_length(series), std::invalid_argument);
  CHECK_THROWS_AS(riesel::autocorrelation_time(series), std::invalid_argument);
  CHECK_THROWS_AS(riesel::estimate_trend(series), std::invalid_argument);
  CHECK_THROWS_AS(riesel::standard_deviation(series), std::invalid_argument);
  std::string message;
  try {
    riesel::estimate_mean(series);
  } catch (const std::invalid_argument& error) {
    message = error.what();
  }
  CHECK(message.find("sample 17") != std::string::npos);
}

TEST_CASE("a handful of samples counts as one", "[time_series]") {
  const riesel::MeanEstimate of_four = riesel::estimate_mean(Series{1.0, 3.0, 1.0, 3.0});
  CHECK(of_four.mean == 2.0);
  CHECK(of_four.error == Approx(std::sqrt(4.0 / 3.0)));  // the standard deviation
  CHECK(of_four.autocorrelation_time == 4.0);
  CHECK(of_four.independent_samples == 1.0);
  CHECK(riesel::estimate_mean(Series{5.0}).mean == 5.0);
  CHECK(riesel::estimate_mean(Series{}).independent_samples == 0.0);
  CHECK(riesel::autocorrelation_time(Series{}) == 1.0);
  CHECK_FALSE(riesel::is_significant(riesel::estimate_trend(line(19, 0.0, 1.0))));
  CHECK(riesel::is_significant(riesel::estimate_trend(line(20, 0.0, 1.0))));
}

TEST_CASE("the transient ends where the offset ends", "[time_series]") {
  Series series(1000);
  for (std::size_t i = 0; i < series.size(); ++i) {
    series[i] = (i % 2 == 0 ? 1.0 : -1.0) + (i < 150 ? 20.0 : 0.0);
  }
  CHECK(riesel::transient_length(series) == 150);
}

TEST_CASE("the transient is at most half of the series", "[time_series]") {
  const std::size_t n = GENERATE(0U, 1U, 4U, 5U, 9U, 10U, 15U, 99U, 1000U, 1003U);
  const std::size_t length = riesel::transient_length(line(n, 0.0, 1.0));
  CHECK(2 * length <= n);
  CHECK(length % 5 == 0);
  if (n >= 20) CHECK(2 * length + 20 >= n);
}

TEST_CASE("estimates scale and shift with the samples", "[time_series]") {
  const Series series = autoregressive(1000, 0.9, 4);
  Series other(series.size());
  std::transform(series.begin(), series.end(), other.begin(),
                 [](double v) { return 100.0 - 8.0 * v; });
  const riesel::MeanEstimate mean = riesel::estimate_mean(series);
  const riesel::MeanEstimate other_mean = riesel::estimate_mean(other);
  CHECK(std::abs(other_mean.mean - (100.0 - 8.0 * mean.mean)) < 1e-11);
  CHECK(std::abs(other_mean.error / mean.error - 8.0) < 1e-9);
  CHECK(std::abs(other_mean.autocorrelation_time / mean.autocorrelation_time - 1.0) < 1e-9);
  const riesel::TrendEstimate trend = riesel::estimate_trend(series);
  const riesel::TrendEstimate other_trend = riesel::estimate_trend(other);
  CHECK(std::abs(other_trend.slope / trend.slope + 8.0) < 1e-9);
  CHECK(std::abs(other_trend.error / trend.error - 8.0) < 1e-9);
}

TEST_CASE("estimates do not know the direction of time", "[time_series]") {
  const Series series = autoregressive(1000, 0.9, 5);
  const Series reversed(series.rbegin(), series.rend());
  const double error = riesel::estimate_mean(series).error;
  CHECK(std::abs(riesel::estimate_mean(reversed).error / error - 1.0) < 1e-9);
  const double slope = riesel::estimate_trend(series).slope;
  CHECK(std::abs(riesel::estimate_trend(reversed).slope / slope + 1.0) < 1e-9);
}

TEST_CASE("the autocorrelation time of AR(1) is found", "[time_series]") {
  // The greater of two estimates errs upwards: by a fifth for white noise, where both are noisy.
  CHECK(std::abs(mean_autocorrelation_time(2000, 0.0) - 1.2) < 0.2);
  CHECK(std::abs(mean_autocorrelation_time(2000, 0.5) - 3.5) < 0.6);
  CHECK(std::abs(mean_autocorrelation_time(4000, 0.9) - 22.0) < 4.0);
  // Where it is as long as the series itself, a twelfth of that is the least to be reported.
  CHECK(riesel::autocorrelation_time(line(1000, 0.0, 1.0)) > 80.0);
}

TEST_CASE("series too long for a sum over all lags have the same autocorrelation time",
          "[time_series]") {
  // Of seeds whose slowest cosines happen to say less than the window does, which is the precise
  // one.
  for (const unsigned seed : {4U, 5U, 8U})
    CHECK(std::abs(riesel::autocorrelation_time(autoregressive(400'000, 0.99, seed)) / 199.0 - 1.0)
          < 0.1);
}

TEST_CASE("a slow component beneath fast noise is seen", "[time_series]") {
  Series series = autoregressive(10000, 0.99, 6);
  const Series noise = autoregressive(10000, 0.0, 7);
  for (std::size_t i = 0; i < series.size(); ++i) series[i] += 3.0 * noise[i];
  const double time = riesel::autocorrelation_time(series);  // truth: (199 + 9)/(1 + 9) = 20.8
  CHECK(time > 8.0);
  CHECK(time < 50.0);
}

TEST_CASE("error bars of the mean keep their word", "[time_series]") {
  // 1000 series: the fraction is known to 1.5 %, and the bounds are three of those beyond 65-72 %.
  const double phi = GENERATE(0.0, 0.5, 0.9);
  const double fraction = coverage(1000, phi);
  CAPTURE(phi, fraction);
  CHECK(fraction > 0.61);
  CHECK(fraction < 0.76);
}

TEST_CASE("too few independent samples are told", "[time_series]") {
  int accepted = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    const riesel::MeanEstimate mean = riesel::estimate_mean(autoregressive(1000, 0.99, seed));
    accepted += mean.independent_samples >= riesel::min_independent_samples;
  }
  CHECK(accepted < 20);  // the truth is 5 independent samples
}

TEST_CASE("one stationary series in a hundred has a false trend", "[time_series]") {
  CHECK(false_trends(200, 0.0) < 0.03);
  CHECK(false_trends(200, 0.9) < 0.04);
  CHECK(false_trends(200, 0.99) < 0.03);  // not to be told from a random walk
}

TEST_CASE("a trend beneath correlated noise is found, with its error", "[time_series]") {
  int found = 0;
  int covered = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    Series series = autoregressive(2000, 0.9, seed);
    for (std::size_t i = 0; i < series.size(); ++i) series[i] += 0.002 * static_cast<double>(i);
    const riesel::TrendEstimate trend = riesel::estimate_trend(series);
    found += riesel::is_significant(trend);
    covered += std::abs(trend.slope - 0.002) <= trend.error;
  }
  CHECK(found > 195);
  CHECK(covered > 110);
  CHECK(covered < 165);
}

TEST_CASE("the error of a ratio whose weight lies in one sample is unknown", "[time_series]") {
  Series linear(30, 0.0), weights(30, 0.0);
  weights[7] = 25.0;
  CHECK(std::isnan(riesel::error_per_weight(linear, weights)));
  weights[8] = 1e-20;
  CHECK(std::isnan(riesel::error_per_weight(linear, weights)));
  weights[8] = 1.0;
  CHECK(riesel::error_per_weight(linear, weights) == 0.0);
}

TEST_CASE("of two batches none is cut off: one has no scatter to compare", "[time_series]") {
  CHECK(riesel::transient_length(Series{1, 2, 1, 2, 1, 2, 1, 2, 1, 2}) == 0);
}

TEST_CASE("where all weights are equal the error is that of the mean", "[time_series]") {
  for (const std::size_t n : {2u, 7u, 60u}) {
    const Series linear = autoregressive(n, 0.3, 11);
    double mean = 0.0;
    for (const double sample : linear) mean += sample / static_cast<double>(n);
    Series deviations = linear;
    for (double& sample : deviations) sample -= mean;
    CHECK(riesel::error_per_weight(deviations, Series(n, 2.0))
          == Approx(riesel::estimate_mean(linear).error));
  }
}

TEST_CASE("each sample is compared with the ratio of all others", "[time_series]") {
  // Weights of 3 and 1, with 2 and 6 per weight: 3 in the mean of all. The first deviates by -3
  // from it and by -12 from the other; for the second it is 3 and 4. The jackknife takes (n - 1)/n.
  const Series linear{-3.0, 3.0}, weights{3.0, 1.0};
  CHECK(riesel::error_per_weight(linear, weights) == Approx(0.5 * (4.0 + 12.0) / std::sqrt(2.0)));
}

TEST_CASE("error bars of ratios of rare events keep their word", "[time_series]") {
  // Five events in the mean, in 100 samples. The linear part as it is covers 55 %.
  std::mt19937 random(5);
  std::poisson_distribution<int> events(0.05);
  std::exponential_distribution<double> size(1.0);
  int covered = 0, known = 0;
  while (known < 2000) {
    Series deviations(100, 0.0), weights(100, 0.0);
    double weight = 0.0, total = 0.0;
    for (std::size_t i = 0; i < deviations.size(); ++i) {
      weights[i] = events(random);
      for (double event = 0.0; event < weights[i]; ++event) deviations[i] += size(random);
      weight += weights[i];
      total += deviations[i];
    }
    if (weight == 0.0) continue;
    const double ratio = total / weight;
    for (std::size_t i = 0; i < deviations.size(); ++i) deviations[i] -= ratio * weights[i];
    const double error = riesel::error_per_weight(deviations, weights) * 100.0 / weight;
    if (std::isnan(error)) continue;
    ++known;
    covered += std::abs(ratio - 1.0) <= error;
  }
  CHECK(covered > 0.61 * known);
  CHECK(covered < 0.70 * known);
}
