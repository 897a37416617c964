#include "engine/time_series.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

namespace riesel {
namespace {

// How many of the slowest cosines measure the noise. With eight the error bar itself scatters by
// 25 %; more would reach into frequencies where the spectrum of a short run is no longer flat.
constexpr std::size_t cosines = 8;

// Student's t for eight degrees of freedom: two-sided 68.27 % and 99 %.
constexpr double student_68 = 1.06653;
constexpr double student_99 = 3.35539;

// The error of a mean grows by this over the number of independent samples. It pays for the fall of
// the spectrum within the cosines, and for the choice among short series: those whose correlation
// is underestimated are the ones that pass as long enough. Measured, see
// docs/statistics-methods.md.
constexpr double finite_sample_allowance = 6.0;

// The random walk is measured on ten blocks: nine steps, whose variance has eight degrees of
// freedom.
constexpr std::size_t blocks = 10;

// The smallest series worth a second look.
constexpr auto min_samples = static_cast<std::size_t>(min_independent_samples);

// A sum over lags costs samples times lags. Longer series are averaged in batches first: what is
// shorter than a batch of these makes no difference to the time, see windowed_time().
constexpr std::size_t most_samples_for_lags = 0x1p16;

// Variations below this fraction of the largest sample are rounding, not motion.
constexpr double resolution = 1e-12;

void require_finite(std::span<const double> series) {
  const auto bad = std::ranges::find_if_not(series, [](double v) { return std::isfinite(v); });
  if (bad == series.end()) return;
  throw std::invalid_argument("sample " + std::to_string(bad - series.begin())
                              + " of the series is " + std::to_string(*bad)
                              + "; statistics need finite samples");
}

/// Summed relative to the first sample, so that the mean of a constant series is exact.
double mean_of(std::span<const double> series) {
  if (series.empty()) return 0.0;
  const double origin = series.front();
  double sum = 0.0;
  for (const double v : series) sum += v - origin;
  return origin + sum / static_cast<double>(series.size());
}

double product(std::span<const double> a, std::span<const double> b) {
  return std::transform_reduce(a.begin(), a.end(), b.begin(), 0.0);
}

/// Mean square.
double power_of(std::span<const double> deviations) {
  return product(deviations, deviations) / static_cast<double>(deviations.size());
}

/// Differences from the mean; zeros for a series that varies by rounding only.
std::vector<double> deviations_from_mean(std::span<const double> series) {
  std::vector<double> deviations(series.begin(), series.end());
  if (series.empty()) return deviations;
  const auto [low, high] = std::ranges::minmax(series);
  const bool varies = high - low > resolution * std::max(std::abs(low), std::abs(high));
  const double mean = mean_of(series);
  for (double& v : deviations) v = varies ? v - mean : 0.0;
  return deviations;
}

/// Time of sample i, counted from the middle of a series of n.
double centred_time(std::size_t i, std::size_t n) {
  return static_cast<double>(i) - 0.5 * static_cast<double>(n - 1);
}

/// Sum of the squares of all centred times.
double sum_of_squared_times(std::size_t n) {
  const auto count = static_cast<double>(n);
  return count * (count * count - 1.0) / 12.0;
}

double least_squares_slope(std::span<const double> deviations) {
  double sum = 0.0;
  for (std::size_t i = 0; i < deviations.size(); ++i) {
    sum += centred_time(i, deviations.size()) * deviations[i];
  }
  return sum / sum_of_squared_times(deviations.size());
}

/// Coefficient of the k-th cosine of the type-II transform, which is orthogonal to a constant and
/// normalised so that white noise of variance s^2 gives coefficients of variance s^2.
double cosine_coefficient(std::span<const double> deviations, std::size_t k) {
  const auto n = static_cast<double>(deviations.size());
  const double frequency = std::numbers::pi * static_cast<double>(k) / n;
  double sum = 0.0;
  for (std::size_t i = 0; i < deviations.size(); ++i) {
    sum += deviations[i] * std::cos(frequency * (static_cast<double>(i) + 0.5));
  }
  return sum * std::sqrt(2.0 / n);
}

/// Long-run variance: n times the variance of the mean of n samples, which is the spectral density
/// at frequency zero. Read off `cosines` of the cosines, from the one numbered `first` upwards.
double long_run_variance(std::span<const double> deviations, std::size_t first) {
  double sum = 0.0;
  for (std::size_t k = first; k < first + cosines; ++k) {
    const double coefficient = cosine_coefficient(deviations, k);
    sum += coefficient * coefficient;
  }
  return sum / static_cast<double>(cosines);
}

/// Autocorrelation time with Sokal's window, which ends at the first lag of five decay times (the
/// integrated time is two of them), and at a fifth of the series at the latest.
double time_by_lags(std::span<const double> deviations) {
  const std::size_t n = deviations.size();
  const double scale = 1.0 / (power_of(deviations) * static_cast<double>(n));
  double time = 1.0;
  std::size_t lag = 0;
  while (lag < n / 5 && static_cast<double>(lag) < 2.5 * time) {
    ++lag;
    time += 2.0 * scale * product(deviations.first(n - lag), deviations.last(n - lag));
  }
  const double bias_of_subtracted_mean = static_cast<double>(2 * lag + 1) / static_cast<double>(n);
  return time * (1.0 + bias_of_subtracted_mean);
}

/// The means of batches of equal length; up to one sample less than a batch is left over.
std::vector<double> means_of_batches(std::span<const double> series, std::size_t batch) {
  std::vector<double> means(series.size() / batch);
  for (std::size_t b = 0; b < means.size(); ++b)
    means[b] = mean_of(series.subspan(b * batch, batch));
  return means;
}

/// The same from means of batches where samples are many: the variance of the mean of all, which is
/// the power of what is averaged times its time over its number, is that of the mean of the
/// batches.
double windowed_time(std::span<const double> deviations) {
  const std::size_t batch = (deviations.size() - 1) / most_samples_for_lags + 1;
  if (batch == 1) return time_by_lags(deviations);
  const std::vector<double> means = means_of_batches(deviations, batch);
  const double part = power_of(means) / power_of(deviations);
  return part == 0.0 ? 1.0 : part * static_cast<double>(batch) * time_by_lags(means);
}

/// Of deviations from a mean (`first_cosine` 1) or from a line (2: the line took the first cosine).
double integrated_time(std::span<const double> deviations, std::size_t first_cosine) {
  const double variance = power_of(deviations);
  if (variance == 0.0) return 1.0;
  const double slow = long_run_variance(deviations, first_cosine) / variance;
  return std::max({1.0, slow, windowed_time(deviations)});
}

/// Standard error of the slope fitted to a random walk that gains the variance w per sample: w
/// shows in the steps from block mean to block mean, of variance 2/3 w times the length of a block;
/// the slope has the variance 6/5 w/n.
double random_walk_slope_error(std::span<const double> series) {
  const std::size_t whole_length = series.size() / blocks;
  const std::vector<double> means =
      means_of_batches(series.first(blocks * whole_length), whole_length);
  std::vector<double> steps(blocks - 1);
  std::transform(means.begin() + 1, means.end(), means.begin(), steps.begin(), std::minus<>());
  const double mean_step = mean_of(steps);
  for (double& step : steps) step -= mean_step;
  const double step_variance = product(steps, steps) / static_cast<double>(blocks - 2);
  const auto block_length = static_cast<double>(whole_length);
  const double walk_variance = 1.5 * step_variance / block_length;
  return std::sqrt(1.2 * walk_variance / static_cast<double>(series.size()));
}

}  // namespace

std::size_t transient_length(std::span<const double> series) {
  require_finite(series);
  constexpr std::size_t batch = 5;
  const std::size_t batches = series.size() / batch;
  // Mean and summed squared deviations of the batches kept: Welford's update, from the end
  // backwards.
  double mean = 0.0;
  double squares = 0.0;
  double least = std::numeric_limits<double>::infinity();
  std::size_t cut = 0;
  for (std::size_t kept = 1; kept <= batches; ++kept) {
    const std::size_t first = batches - kept;
    const auto count = static_cast<double>(kept);
    const double value = mean_of(series.subspan(first * batch, batch));
    const double step = value - mean;
    mean += step / count;
    squares += step * (value - mean);

    const double squared_error = squares / (count * count);
    const bool in_first_half = 2 * first <= batches;
    if (in_first_half && squared_error <= least) {
      least = squared_error;
      cut = first;
    }
  }
  return cut * batch;
}

double autocorrelation_time(std::span<const double> series) {
  require_finite(series);
  if (series.size() < min_samples) return std::max(1.0, static_cast<double>(series.size()));
  return integrated_time(deviations_from_mean(series), 1);
}

double standard_deviation(std::span<const double> series) {
  if (series.size() < 2) return 0.0;
  const std::vector<double> deviations = deviations_from_mean(series);
  return std::sqrt(product(deviations, deviations) / static_cast<double>(series.size() - 1));
}

MeanEstimate estimate_mean(std::span<const double> series) {
  require_finite(series);
  if (series.empty()) {
    return {.mean = 0, .error = 0, .autocorrelation_time = 1, .independent_samples = 0};
  }
  const auto n = static_cast<double>(series.size());
  const std::vector<double> deviations = deviations_from_mean(series);
  if (series.size() < min_samples) {
    return {.mean = mean_of(series),
            .error = std::sqrt(power_of(deviations)),
            .autocorrelation_time = n,
            .independent_samples = 1};
  }
  const double time = integrated_time(deviations, 1);
  const double independent = n / time;
  const double allowance = 1.0 + finite_sample_allowance / independent;
  return {.mean = mean_of(series),
          .error = student_68 * allowance * std::sqrt(long_run_variance(deviations, 1) / n),
          .autocorrelation_time = time,
          .independent_samples = independent};
}

TrendEstimate estimate_trend(std::span<const double> series) {
  require_finite(series);
  const std::size_t n = series.size();
  if (n < min_samples) return {.slope = 0, .error = 0};
  std::vector<double> residuals = deviations_from_mean(series);
  const double slope = least_squares_slope(residuals);
  for (std::size_t i = 0; i < n; ++i) residuals[i] -= slope * centred_time(i, n);

  double error = std::sqrt(long_run_variance(residuals, 2) / sum_of_squared_times(n));
  const double independent = static_cast<double>(n) / integrated_time(residuals, 2);
  if (independent < min_independent_samples) {
    error = std::max(error, random_walk_slope_error(residuals));
  }
  return {.slope = slope, .error = student_68 * error};
}

bool is_significant(const TrendEstimate& trend) {
  return std::abs(trend.slope) * student_68 > student_99 * trend.error;
}

}  // namespace riesel
