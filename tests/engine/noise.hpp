// Noise with a memory, for tests of statistics.
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <random>
#include <vector>

namespace riesel {

/// Stationary AR(1) of mean 0 and variance 1, x_i = phi x_(i-1) + noise, with autocorrelation time
/// (1 + phi)/(1 - phi). gaussian(): independent numbers of mean 0 and variance 1.
template <std::invocable Gaussian>
std::vector<double> autoregressive(std::size_t n, double phi, Gaussian gaussian) {
  std::vector<double> series(n);
  double x = gaussian();
  for (double& sample : series) {
    sample = x;
    x = phi * x + std::sqrt(1.0 - phi * phi) * gaussian();
  }
  return series;
}

inline std::vector<double> autoregressive(std::size_t n, double phi, unsigned seed) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal;
  return autoregressive(n, phi, [&] { return normal(generator); });
}

}  // namespace riesel
