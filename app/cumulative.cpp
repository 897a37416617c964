#include "app/cumulative.hpp"

#include "engine/time_series.hpp"

#include <numeric>

namespace riesel::app {
namespace {

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

}  // namespace

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
  const double error = steps.size() > 1 ? estimate_mean(steps).error : unknown;
  return {.value = total(name) / duration, .error = error / interval_};
}

io::Measured CumulativeSeries::ratio(const std::string& part, const std::string& whole) const {
  std::vector<double> deviations = increments(part);
  const std::vector<double> weights = increments(whole);
  const double weight = sum(weights);
  if (weight == 0.0) return {.value = unknown, .error = unknown};
  const double ratio = total(part) / weight;
  for (std::size_t i = 0; i < deviations.size(); ++i) deviations[i] -= ratio * weights[i];
  const double mean_weight = weight / static_cast<double>(weights.size());
  return {.value = ratio, .error = error_per_weight(deviations, weights) / mean_weight};
}

}  // namespace riesel::app
