#include "app/cumulative.hpp"

#include "engine/time_series.hpp"

#include <cmath>

namespace riesel::app {

std::vector<double> CumulativeSeries::increments(const std::string& name) const {
  const std::vector<double> series = file_->series(name);
  std::vector<double> steps;
  for (std::size_t i = first_ + 1; i < series.size(); ++i)
    steps.push_back(series[i] - series[i - 1]);
  return steps;
}

double CumulativeSeries::total(const std::string& name) const {
  const std::vector<double> series = file_->series(name);
  return series.back() - series[first_];
}

io::Measured CumulativeSeries::rate(const std::string& name) const {
  const std::vector<double> steps = increments(name);
  const double duration = interval_ * static_cast<double>(steps.size());
  return {.value = total(name) / duration, .error = mean_with_error(steps).error / interval_};
}

double CumulativeSeries::error_of_sum(const std::string& one, const std::string& other,
                                      double factor) const {
  std::vector<double> steps = increments(one);
  const std::vector<double> others = increments(other);
  for (std::size_t i = 0; i < steps.size(); ++i) steps[i] += factor * others[i];
  return mean_with_error(steps).error / interval_;
}

double CumulativeSeries::quotient(const std::string& part, const std::string& whole) const {
  const double divisor = total(whole);
  return divisor == 0.0 ? unknown : total(part) / divisor;
}

io::Measured CumulativeSeries::ratio(const std::string& part, const std::string& counted) const {
  const double ratio = quotient(part, counted);
  if (std::isnan(ratio)) return {.value = unknown, .error = unknown};
  std::vector<double> deviations = increments(part);
  const std::vector<double> weights = increments(counted);
  for (std::size_t i = 0; i < deviations.size(); ++i) deviations[i] -= ratio * weights[i];
  const double mean_weight = total(counted) / static_cast<double>(weights.size());
  return {.value = ratio, .error = error_per_weight(deviations, weights) / mean_weight};
}

}  // namespace riesel::app
