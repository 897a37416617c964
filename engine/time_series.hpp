// The statistics of one evenly sampled, correlated series: where its transient ends, its mean with
// a reliable error bar, and its trend.
//
// Successive samples of a flow are correlated, so the textbook error of a mean is far too small.
// The usual cure, to sum the autocorrelation function up to a window, overlooks a slow component
// beneath fast noise. The errors here are taken from the slowest variations themselves, eight
// cosines across the whole series, with Student's distribution for so small a number. See
// docs/statistics-methods.md for formulas and measurements.
//
// The unit of time is the sample interval. The functions are pure, and throw std::invalid_argument
// for a sample that is not finite.
#pragma once

#include "engine/estimate.hpp"

#include <cstddef>
#include <span>

namespace riesel {

/// Fewer independent samples than this are too few to judge a mean or its error.
inline constexpr double min_independent_samples = 20.0;

/// A mean and how well it is known. `mean` and `error` in the unit of the samples.
struct MeanEstimate {
  double mean;
  double error;  ///< half width of the interval that covers the truth in 68 % of cases
  double autocorrelation_time;  ///< sample intervals per independent sample, >= 1
  double independent_samples;   ///< below `min_independent_samples` the error may be too small
};

/// The slope of a straight line through the series, in the unit of the samples per sample interval.
struct TrendEstimate {
  double slope;
  double error;  ///< half width of the interval that covers the truth in 68 % of cases
};

/// Number of leading samples to discard: MSER-5, the cut that leaves the mean of the rest with the
/// smallest nominal standard error, judged on means of five, searched in the first half only.
/// White, Cobb and Spratt, Proc. Winter Simulation Conf. 2000, 755; Hoad, Robinson and Davies,
/// J. Oper. Res. Soc. 61, 1389 (2010).
std::size_t transient_length(std::span<const double> series);

/// Integrated autocorrelation time 1 + 2 (rho_1 + rho_2 + ...) >= 1, in sample intervals: the
/// greater of the windowed sum (Sokal, Cargese lectures 1996, self-consistent window; bias
/// correction of Wolff, Comput. Phys. Commun. 156, 143 (2004)) and of the estimate from the eight
/// slowest cosines. The first is precise, the second includes what the window cuts off. Where it
/// exceeds a twelfth of the series it is only a lower bound; the length of the series if that is
/// below 20. 1 for a constant series.
double autocorrelation_time(std::span<const double> series);

/// Sample standard deviation, with n - 1; 0 for fewer than two samples.
double standard_deviation(std::span<const double> series);

/// Mean and standard error from the eight slowest cosines: Müller, J. Bus. Econ. Stat. 32, 311
/// (2014); Lazarus, Lewis, Stock and Watson, ibid. 36, 541 (2018). Fewer than 20 samples count as
/// one independent sample, whose error is the standard deviation; none at all give zeros.
MeanEstimate estimate_mean(std::span<const double> series);

/// The same for printing: the error of a single sample is unknown, and so is the mean of none.
Estimate mean_with_error(std::span<const double> series);

/// The error of a quantity that is counted per weight, such as a sum of parts over a sum of
/// weights. `linear`: what each sample contributes to its linear part (0 in the mean over all
/// samples); `weights`, none below 0, as many. A sample that holds a large part of the weight has
/// drawn the quantity towards itself: each is compared with what the others give (the jackknife).
/// Unknown if one sample holds all of the weight, but for rounding.
double error_per_weight(std::span<const double> linear, std::span<const double> weights);

/// Least-squares slope. Its error is taken from cosines of the residuals, as for the mean. If too
/// few of them are independent, they cannot be distinguished from a random walk, and the error is
/// at least that of the slope of a random walk (Durlauf and Phillips, Econometrica 56, 1333
/// (1988)). Zeros for fewer than 20 samples.
TrendEstimate estimate_trend(std::span<const double> series);

/// Whether the slope differs from zero, at a nominal false-alarm rate of 1 %.
bool is_significant(const TrendEstimate& trend);

}  // namespace riesel
