#include "engine/time_series.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

namespace riesel {
namespace {

// How many of the slowest cosines measure the noise. With eight the error bar itself scatters by
// 25 %; more would reach into frequencies where the spectrum of a short run is no longer flat.
constexpr Eigen::Index cosines = 8;

// Student's t for eight degrees of freedom: two-sided 68.27 % and 99 %.
constexpr double student_68 = 1.06653;
constexpr double student_99 = 3.35539;

// The error of a mean is enlarged by a part of itself: this over the number of independent samples.
// That allows for the fall of the spectrum within the cosines, and for a selection among short
// series: those whose correlation is underestimated are the ones that count as long enough.
// Measured: see docs/statistics-methods.md.
constexpr double finite_sample_allowance = 6.0;

// The random walk is measured on ten blocks: nine steps, whose variance has eight degrees of
// freedom.
constexpr Eigen::Index blocks = 10;

// The shortest series that is analysed at all.
constexpr auto min_samples = static_cast<std::size_t>(min_independent_samples);

// A sum over lags costs samples times lags. Longer series are averaged in batches first, which does
// not change the result noticeably: see windowed_time().
constexpr Eigen::Index most_samples_for_lags = 0x1p16;

// Variations below this fraction of the largest sample are rounding, not motion.
constexpr double resolution = 1e-12;

using Eigen::ArrayXd;
using Eigen::Index;
using Samples = Eigen::Ref<const ArrayXd>;

/// Throws std::invalid_argument for samples that are not finite.
Eigen::Map<const ArrayXd> finite_samples(std::span<const double> series) {
  const auto bad = std::ranges::find_if_not(series, [](double v) { return std::isfinite(v); });
  if (bad != series.end())
    throw std::invalid_argument("sample " + std::to_string(bad - series.begin())
                                + " of the series is " + std::to_string(*bad)
                                + "; statistics need finite samples");
  return {series.data(), std::ssize(series)};
}

/// Summed relative to the first sample, so that the mean of a constant series is exact.
double mean_of(const Samples& series) {
  return series.size() == 0 ? 0.0 : series[0] + (series - series[0]).mean();
}

/// Mean square.
double power_of(const Samples& deviations) { return deviations.square().mean(); }

/// Differences from the mean; zeros for a series that varies by rounding only.
ArrayXd deviations_from_mean(const Samples& series) {
  if (series.size() == 0) return series;
  const double spread = series.maxCoeff() - series.minCoeff();
  if (spread <= resolution * series.abs().maxCoeff()) return ArrayXd::Zero(series.size());
  return series - mean_of(series);
}

/// Times of n samples, counted from the middle.
ArrayXd centred_times(Index n) {
  const double last = 0.5 * static_cast<double>(n - 1);
  return ArrayXd::LinSpaced(n, -last, last);
}

/// Coefficient of the k-th cosine of the type-II transform, which is orthogonal to a constant and
/// normalised so that white noise of variance s^2 gives coefficients of variance s^2.
double cosine_coefficient(const Samples& deviations, Index k) {
  const Index n = deviations.size();
  const double frequency = std::numbers::pi * static_cast<double>(k) / static_cast<double>(n);
  const ArrayXd times = centred_times(n) + 0.5 * static_cast<double>(n);
  return (deviations * (frequency * times).cos()).sum() * std::sqrt(2.0 / static_cast<double>(n));
}

/// Long-run variance: n times the variance of the mean of n samples, which is the spectral density
/// at frequency zero. Read off `cosines` of the cosines, from the one numbered `first` upwards.
double long_run_variance(const Samples& deviations, Index first) {
  double sum = 0.0;
  for (Index k = first; k < first + cosines; ++k) {
    const double coefficient = cosine_coefficient(deviations, k);
    sum += coefficient * coefficient;
  }
  return sum / static_cast<double>(cosines);
}

/// Autocorrelation time with Sokal's window, which ends at the first lag beyond five decay times
/// (one decay time is half of the integrated time), but at a fifth of the series at the latest.
double time_by_lags(const Samples& deviations) {
  const Index n = deviations.size();
  const double scale = 1.0 / deviations.square().sum();
  double time = 1.0;
  Index lag = 0;
  while (lag < n / 5 && static_cast<double>(lag) < 2.5 * time) {
    ++lag;
    time += 2.0 * scale * (deviations.head(n - lag) * deviations.tail(n - lag)).sum();
  }
  const double bias_of_subtracted_mean = static_cast<double>(2 * lag + 1) / static_cast<double>(n);
  return time * (1.0 + bias_of_subtracted_mean);
}

/// The means of batches of equal length; up to one sample less than a batch is left over.
ArrayXd means_of_batches(const Samples& series, Index batch) {
  ArrayXd means(series.size() / batch);
  for (Index b = 0; b < means.size(); ++b) means[b] = mean_of(series.segment(b * batch, batch));
  return means;
}

/// The same, where samples are many from the means of batches: the variance of the mean of all,
/// power times autocorrelation time over number, is the same for samples and for batch means.
double windowed_time(const Samples& deviations) {
  const Index batch = (deviations.size() - 1) / most_samples_for_lags + 1;
  if (batch == 1) return time_by_lags(deviations);
  const ArrayXd means = means_of_batches(deviations, batch);
  const double part = power_of(means) / power_of(deviations);
  return part == 0.0 ? 1.0 : part * static_cast<double>(batch) * time_by_lags(means);
}

/// Autocorrelation time of deviations from a mean (`first_cosine` 1) or from a fitted line (2, as
/// the line has taken up the first cosine).
double integrated_time(const Samples& deviations, Index first_cosine) {
  const double variance = power_of(deviations);
  if (variance == 0.0) return 1.0;
  const double slow = long_run_variance(deviations, first_cosine) / variance;
  return std::max({1.0, slow, windowed_time(deviations)});
}

/// Standard error of the slope fitted to a random walk. If its variance grows by w per sample, the
/// differences of successive block means have the variance 2/3 w times the length of a block, from
/// which w is estimated; the slope has the variance 6/5 w/n.
double random_walk_slope_error(const Samples& series) {
  const Index block = series.size() / blocks;
  const ArrayXd means = means_of_batches(series.head(blocks * block), block);
  const ArrayXd steps = means.tail(blocks - 1) - means.head(blocks - 1);
  const double step_variance =
      (steps - mean_of(steps)).square().sum() / static_cast<double>(blocks - 2);
  const double walk_variance = 1.5 * step_variance / static_cast<double>(block);
  return std::sqrt(1.2 * walk_variance / static_cast<double>(series.size()));
}

}  // namespace

std::size_t transient_length(std::span<const double> series) {
  constexpr Index batch = 5;
  const ArrayXd means = means_of_batches(finite_samples(series), batch);
  // Mean and summed squared deviations of the batches kept: Welford's update, from the end
  // backwards.
  double mean = 0.0;
  double squares = 0.0;
  double least = std::numeric_limits<double>::infinity();
  Index cut = 0;
  for (Index first = means.size() - 1; first >= 0; --first) {
    const Index kept = means.size() - first;
    const auto count = static_cast<double>(kept);
    const double step = means[first] - mean;
    mean += step / count;
    squares += step * (means[first] - mean);

    const double squared_error = squares / (count * count);
    const bool in_first_half = 2 * first <= means.size(), has_scatter = kept > 1;
    if (in_first_half && has_scatter && squared_error <= least) {
      least = squared_error;
      cut = first;
    }
  }
  return static_cast<std::size_t>(cut * batch);
}

double autocorrelation_time(std::span<const double> series) {
  const auto samples = finite_samples(series);
  if (series.size() < min_samples) return std::max(1.0, static_cast<double>(series.size()));
  return integrated_time(deviations_from_mean(samples), 1);
}

double standard_deviation(std::span<const double> series) {
  const auto samples = finite_samples(series);
  if (series.size() < 2) return 0.0;
  const ArrayXd deviations = deviations_from_mean(samples);
  return std::sqrt(deviations.square().sum() / static_cast<double>(series.size() - 1));
}

MeanEstimate estimate_mean(std::span<const double> series) {
  const auto samples = finite_samples(series);
  if (series.empty()) {
    return {.mean = 0, .error = 0, .autocorrelation_time = 1, .independent_samples = 0};
  }
  const auto n = static_cast<double>(series.size());
  const ArrayXd deviations = deviations_from_mean(samples);
  if (series.size() < min_samples) {
    return {.mean = mean_of(samples),
            .error = standard_deviation(series),
            .autocorrelation_time = n,
            .independent_samples = 1};
  }
  const double time = integrated_time(deviations, 1);
  const double independent = n / time;
  const double allowance = 1.0 + finite_sample_allowance / independent;
  return {.mean = mean_of(samples),
          .error = student_68 * allowance * std::sqrt(long_run_variance(deviations, 1) / n),
          .autocorrelation_time = time,
          .independent_samples = independent};
}

Estimate mean_with_error(std::span<const double> series) {
  if (series.empty()) return {unknown, unknown};
  const MeanEstimate estimate = estimate_mean(series);
  return {estimate.mean, series.size() > 1 ? estimate.error : unknown};
}

double error_per_weight(std::span<const double> linear, std::span<const double> weights) {
  const auto of_all = finite_samples(linear);
  const auto weight = finite_samples(weights);
  if ((weight >= weight.sum()).any()) return unknown;
  const auto n = static_cast<double>(of_all.size());
  const ArrayXd from_others = (n - 1.0) / n * of_all / (1.0 - weight / weight.sum());
  return estimate_mean({from_others.data(), static_cast<std::size_t>(from_others.size())}).error;
}

TrendEstimate estimate_trend(std::span<const double> series) {
  const auto samples = finite_samples(series);
  if (series.size() < min_samples) return {.slope = 0, .error = 0};
  const ArrayXd deviations = deviations_from_mean(samples);
  const ArrayXd times = centred_times(samples.size());
  const double sum_of_squared_times = times.square().sum();
  const double slope = (times * deviations).sum() / sum_of_squared_times;
  const ArrayXd residuals = deviations - slope * times;

  double error = std::sqrt(long_run_variance(residuals, 2) / sum_of_squared_times);
  const double independent = static_cast<double>(series.size()) / integrated_time(residuals, 2);
  if (independent < min_independent_samples) {
    error = std::max(error, random_walk_slope_error(residuals));
  }
  return {.slope = slope, .error = student_68 * error};
}

bool is_significant(const TrendEstimate& trend) {
  return std::abs(trend.slope) * student_68 > student_99 * trend.error;
}

}  // namespace riesel
