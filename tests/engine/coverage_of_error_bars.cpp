// How often the error bars of the engine cover the truth, how often a stationary series is called
// unsteady, how often an unsteady one is caught, and what becomes of the error bars if a run ends
// when they are small: the tables of docs/statistics-methods.md.
//
// Thousands of series per line take minutes, so this is no unit test but a program to be run by
// hand. Its argument is the number of series per line; with 4000 of them a rate of 68 % is known to
// 0.7 %, and one of 1 % to 0.16 %; with 1000 to twice that. The word `stopped` after it asks for
// the last table alone.

#include "engine/steady_state.hpp"
#include "engine/stopping_rule.hpp"
#include "engine/time_series.hpp"
#include "tests/engine/noise.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <numbers>
#include <random>
#include <string_view>
#include <utility>
#include <vector>

namespace {

using Series = std::vector<double>;
using riesel::SteadyVerdict;

std::mt19937_64 generator(20240229);

double gaussian() {
  static std::normal_distribution<double> normal;
  return normal(generator);
}

Series autoregressive(std::size_t n, double phi) {
  return riesel::autoregressive(n, phi, gaussian);
}

/// Stationary AR(2) of mean 0 and variance 1: waves of this period (samples) that are forgotten
/// within `decay` (samples).
struct Waves {
  double period, decay;

  double first() const {
    return 2.0 * std::exp(-1.0 / decay) * std::cos(2.0 * std::numbers::pi / period);
  }
  double second() const { return -std::exp(-2.0 / decay); }
  /// Of the noise, for a variance of 1.
  double noise_variance() const {
    const double a = first(), b = second();
    return (1.0 + b) * ((1.0 - b) * (1.0 - b) - a * a) / (1.0 - b);
  }
  /// n times the variance of the mean of n samples, where n is large.
  double time() const { return noise_variance() / std::pow(1.0 - first() - second(), 2); }

  Series series(std::size_t n) const {
    const double a = first(), b = second(), noise = std::sqrt(noise_variance());
    const double correlation = a / (1.0 - b);  // of neighbours
    double before = gaussian();
    double x = correlation * before + std::sqrt(1.0 - correlation * correlation) * gaussian();
    Series series(n);
    for (double& sample : series) {
      sample = before;
      before = std::exchange(x, a * x + b * before + noise * gaussian());
    }
    return series;
  }
};

/// An AR(1) of phi = 0.99 beneath white noise that carries nine tenths of the variance.
Series slow_beneath_fast(std::size_t n) {
  Series series = autoregressive(n, 0.99);
  for (double& sample : series) sample += 3.0 * gaussian();
  return series;
}

Series random_walk(std::size_t n) {
  Series series(n);
  double x = 0.0;
  for (double& sample : series) sample = x += gaussian();
  return series;
}

/// `signal`, a function of the fraction of the series that has passed, with AR(1) noise of phi =
/// 0.9.
Series with_noise(std::size_t n, double noise, const std::function<double(double)>& signal) {
  Series series = autoregressive(n, 0.9);
  for (std::size_t i = 0; i < n; ++i) {
    series[i] = noise * series[i] + signal(static_cast<double>(i) / static_cast<double>(n));
  }
  return series;
}

double percent(int part, int whole) { return whole > 0 ? 100.0 * part / whole : 0.0; }

/// How often an error bar covers the truth, and how often twice the error bar does.
struct Coverage {
  int bars = 0, covered = 0, covered_twice = 0;

  void add(double miss, double error) {
    ++bars;
    covered += std::abs(miss) <= error;
    covered_twice += std::abs(miss) <= 2.0 * error;
  }
  double once() const { return percent(covered, bars); }
  double twice() const { return percent(covered_twice, bars); }
};

/// Prints one line on stationary series of mean 0 and the given autocorrelation time.
void print_stationary(const char* label, std::size_t n, double time, int count,
                      const std::function<Series()>& make) {
  Coverage of_mean;   // error bars of means that rest on enough independent samples
  Coverage of_state;  // the same of states that are called steady
  double measured_time = 0.0;
  int false_trends = 0;
  std::map<SteadyVerdict, int> verdicts;
  for (int i = 0; i < count; ++i) {
    const Series series = make();
    const riesel::MeanEstimate mean = riesel::estimate_mean(series);
    measured_time += mean.autocorrelation_time / count;
    if (mean.independent_samples >= riesel::min_independent_samples)
      of_mean.add(mean.mean, mean.error);
    false_trends += riesel::is_significant(riesel::estimate_trend(series));
    const riesel::SteadyState state = riesel::assess_steady_state(series);
    ++verdicts[state.verdict];
    if (state.verdict == SteadyVerdict::steady) of_state.add(state.mean, state.error);
  }
  const int alarms = verdicts[SteadyVerdict::drifting] + verdicts[SteadyVerdict::accelerating];
  std::printf("| %-4s | %5zu | %7.1f | %5.1f | %5.1f | %3.0f | %4.1f | %4.1f | %4.1f | %3.0f | "
              "%4.1f | %4.1f "
              "| %4.1f |\n",
              label, n, static_cast<double>(n) / time, time, measured_time,
              percent(of_mean.bars, count), of_mean.once(), of_mean.twice(),
              percent(false_trends, count), percent(verdicts[SteadyVerdict::too_short], count),
              percent(alarms, count), of_state.once(), of_state.twice());
}

void print_stationary_table(int count) {
  std::puts("| | n | n/tau | tau | found | enough | 1 err | 2 err | trend | too short | alarm | 1 "
            "err | 2 err |");
  std::puts("|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|");
  for (const double phi : {0.0, 0.5, 0.9, 0.99}) {
    std::array<char, 8> label{};
    std::snprintf(label.data(), label.size(), "%.2f", phi);
    for (const std::size_t n : {200U, 1000U, 10000U}) {
      print_stationary(label.data(), n, (1.0 + phi) / (1.0 - phi), count,
                       [&] { return autoregressive(n, phi); });
    }
  }
  for (const std::size_t n : {400U, 600U, 2000U, 4000U}) {
    print_stationary("0.90", n, 19.0, count, [&] { return autoregressive(n, 0.9); });
  }
  for (const std::size_t n : {1000U, 4000U, 10000U}) {
    print_stationary("slow", n, (9.0 + 199.0) / 10.0, count, [&] { return slow_beneath_fast(n); });
  }
  for (const Waves& waves :
       {Waves{20.0, 5.0}, Waves{20.0, 20.0}, Waves{20.0, 200.0}, Waves{100.0, 100.0}}) {
    std::array<char, 16> label{};
    std::snprintf(label.data(), label.size(), "%.0f, %.0f", waves.period, waves.decay);
    for (const std::size_t n : {200U, 1000U, 10000U})
      print_stationary(label.data(), n, waves.time(), count, [&] { return waves.series(n); });
  }
}

/// Prints one line on series that are steady, if at all, with mean `truth`.
void print_verdicts(const char* label, double truth, int count,
                    const std::function<Series()>& make) {
  Coverage of_state;
  std::map<SteadyVerdict, int> verdicts;
  for (int i = 0; i < count; ++i) {
    const riesel::SteadyState state = riesel::assess_steady_state(make());
    ++verdicts[state.verdict];
    if (state.verdict == SteadyVerdict::steady) of_state.add(state.mean - truth, state.error);
  }
  std::printf("| %-52s | %5.1f | %5.1f | %5.1f | %5.1f | %5.1f |\n", label,
              percent(verdicts[SteadyVerdict::accelerating], count),
              percent(verdicts[SteadyVerdict::drifting], count),
              percent(verdicts[SteadyVerdict::too_short], count),
              percent(verdicts[SteadyVerdict::steady], count), of_state.once());
}

void print_power_table(int count) {
  constexpr std::size_t n = 2000;
  const auto line = [&](const char* label, double truth, double noise, auto signal) {
    print_verdicts(label, truth, count, [&] { return with_noise(n, noise, signal); });
  };
  const auto approach = [](double times) {
    return [times](double passed) { return 1.0 - std::exp(-times * passed); };
  };
  std::puts("| | accelerating | drifting | too short | steady | covered |");
  std::puts("|---|--:|--:|--:|--:|--:|");
  line("free fall from rest, noise 5 % of the last velocity", 0, 0.05, [](double s) { return s; });
  line("free fall from rest, noise 20 %", 0, 0.2, [](double s) { return s; });
  line("free fall from rest, noise 50 %", 0, 0.5, [](double s) { return s; });
  line("slow fall, mean 1, gain 0.3, noise 5 %", 0, 0.05, [](double s) { return 0.85 + 0.3 * s; });
  line("approach 1 - exp(-t/T), noise 0.1 %, seen for 1 T", 0, 0.001, approach(1));
  line("approach, noise 5 %, seen for 1 T", 0, 0.05, approach(1));
  line("approach, noise 5 %, seen for 2 T", 0, 0.05, approach(2));
  line("approach, noise 5 %, seen for 3 T", 0, 0.05, approach(3));
  line("approach, noise 5 %, seen for 5 T", 1, 0.05, approach(5));
  line("approach, noise 5 %, seen for 7 T", 1, 0.05, approach(7));
  line("approach, noise 5 %, seen for 10 T", 1, 0.05, approach(10));
  line("approach, noise 1 %, seen for 10 T", 1, 0.01, approach(10));
  line("approach, noise 1 %, seen for 15 T", 1, 0.01, approach(15));
  line("approach, noise 5 %, seen for 30 T", 1, 0.05, approach(30));
  line("decay 1 + 2 exp(-t/T), noise 5 %, seen for 2 T", 0, 0.05,
       [](double s) { return 1.0 + 2.0 * std::exp(-2.0 * s); });
  line("decay, noise 5 %, seen for 20 T", 1, 0.05,
       [](double s) { return 1.0 + 2.0 * std::exp(-20.0 * s); });
  line("jump from 1 to 1.1 after 3/4 of the run, noise 5 %", 0, 0.05,
       [](double s) { return s < 0.75 ? 1.0 : 1.1; });
  for (const double gain : {4.0, 8.0, 12.0, 16.0, 20.0, 24.0}) {
    // sqrt(19/n) is the error of the mean over the whole run, in units of the noise.
    const double slope = gain * std::sqrt(19.0 / static_cast<double>(n));
    std::array<char, 64> label{};
    std::snprintf(label.data(), label.size(), "line that gains %.0f errors of the mean", gain);
    line(label.data(), 100, 1.0, [slope](double s) { return 100.0 + slope * (s - 0.5); });
  }
  print_verdicts("random walk from 0", 0, count, [] { return random_walk(n); });
  print_verdicts("random walk about 1000", 0, count, [] {
    Series series = random_walk(n);
    for (double& sample : series) sample += 1000.0;
    return series;
  });
}

/// A series that goes on and on: the next sample at each call.
using Source = std::function<double()>;

Source autoregressive_source(double phi) {
  return [phi, x = gaussian()]() mutable {
    const double sample = x;
    x = phi * x + std::sqrt(1.0 - phi * phi) * gaussian();
    return sample;
  };
}

Source slow_beneath_fast_source() {
  return [slow = autoregressive_source(0.99)] { return slow() + 3.0 * gaussian(); };
}

/// An AR(1) of phi = 0.9 that comes from far off, in 200 samples by a factor e.
Source approaching_source() {
  return [noise = autoregressive_source(0.9), offset = 20.0]() mutable {
    offset *= std::exp(-1.0 / 200.0);
    return noise() - offset;
  };
}

/// Prints one line on runs that end by the stopping rule. `enough` is the length at which the error
/// of the mean, in truth, is the one that is asked for.
void print_stopped(const char* label, double variance, double time, double enough, int count,
                   const std::function<Source()>& make) {
  constexpr double mean = 100.0;
  const double relative_error = std::sqrt(variance * time / enough) / mean;
  const auto at_most = static_cast<std::size_t>(20.0 * enough);
  Coverage coverage;
  double length = 0.0;
  for (int i = 0; i < count; ++i) {
    const Source next = make();
    Series series;
    while (series.size() < at_most) {
      series.push_back(mean + next());
      const riesel::FlowSeries flow{series, std::nullopt, {series}};
      if (!riesel::is_time_to_look(series.size()) || !riesel::is_precise(flow, relative_error))
        continue;
      const riesel::SteadyState state = riesel::assess_steady_state(series);
      coverage.add(state.mean - mean, state.error);
      length += static_cast<double>(series.size());
      break;
    }
  }
  std::printf("| %-8s | %6.0f | %6.0f | %5.1f | %4.2f | %4.1f | %4.1f |\n", label, enough,
              enough / time, percent(coverage.bars, count), length / coverage.bars / enough,
              coverage.once(), coverage.twice());
}

void print_stopped_table(int count) {
  std::puts("| | enough | enough/tau | ended | length/enough | 1 err | 2 err |");
  std::puts("|---|--:|--:|--:|--:|--:|--:|");
  for (const double enough : {200.0, 1000.0, 5000.0}) {
    print_stopped("0.00", 1.0, 1.0, enough, count, [] { return autoregressive_source(0.0); });
  }
  for (const double enough : {400.0, 1000.0, 2000.0, 8000.0}) {
    print_stopped("0.90", 1.0, 19.0, enough, count, [] { return autoregressive_source(0.9); });
  }
  for (const double enough : {4000.0, 10000.0}) {
    print_stopped("0.99", 1.0, 199.0, enough, count, [] { return autoregressive_source(0.99); });
  }
  for (const double enough : {1000.0, 4000.0, 10000.0}) {
    print_stopped("slow", 10.0, 20.8, enough, count, slow_beneath_fast_source);
  }
  for (const double enough : {1000.0, 4000.0}) {
    print_stopped("approach", 1.0, 19.0, enough, count, approaching_source);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int count = argc > 1 ? std::atoi(argv[1]) : 1000;
  const bool all = argc < 3 || std::string_view(argv[2]) != "stopped";
  if (all) {
    print_stationary_table(count);
    std::puts("");
    print_power_table(count);
    std::puts("");
  }
  print_stopped_table(count);
}
