// The verdict on runs whose fate is known: falls, approaches, decays, walks, and honest steady
// states.

#include "engine/steady_state.hpp"

#include "tests/catch.hpp"
#include "tests/engine/noise.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <random>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

namespace {

using riesel::SteadyState;
using riesel::SteadyVerdict;
using Series = std::vector<double>;

/// `signal` of the fraction of the run that has passed, with AR(1) noise of correlation `phi`.
Series noisy(std::size_t n, double noise, double phi, unsigned seed,
             const std::function<double(double)>& signal) {
  Series series = riesel::autoregressive(n, phi, seed);
  for (std::size_t i = 0; i < n; ++i)
    series[i] = signal(static_cast<double>(i) / static_cast<double>(n)) + noise * series[i];
  return series;
}

/// 1 - exp(-t/T), seen for `times` T.
std::function<double(double)> approach(double times) {
  return [times](double passed) { return 1.0 - std::exp(-times * passed); };
}

double constant(double) { return 1.0; }
double free_fall(double passed) { return passed; }

constexpr unsigned runs = 100;

/// Verdicts on `runs` noisy runs of 2000 samples, of which 19 make one independent.
std::map<SteadyVerdict, int> verdicts(const std::function<double(double)>& signal) {
  std::map<SteadyVerdict, int> count;
  for (unsigned seed = 0; seed < runs; ++seed) {
    ++count[riesel::assess_steady_state(noisy(2000, 0.05, 0.9, seed, signal)).verdict];
  }
  return count;
}

}  // namespace

TEST_CASE("verdicts are written by name", "[steady_state]") {
  CHECK(riesel::name(SteadyVerdict::steady) == "steady");
  CHECK(riesel::name(SteadyVerdict::accelerating) == "accelerating");
  CHECK(riesel::name(SteadyVerdict::drifting) == "drifting");
  CHECK(riesel::name(SteadyVerdict::too_short) == "too_short");
  for (const auto verdict : {SteadyVerdict::steady, SteadyVerdict::accelerating,
                             SteadyVerdict::drifting, SteadyVerdict::too_short})
    CHECK(riesel::steady_verdict_named(riesel::name(verdict)) == verdict);
  CHECK_FALSE(riesel::steady_verdict_named("valid"));
}

TEST_CASE("a constant velocity is steady without error", "[steady_state]") {
  const SteadyState state = riesel::assess_steady_state(Series(100, 0.7), 0.01);
  CHECK(state.verdict == SteadyVerdict::steady);
  CHECK(state.transient_end == 0);
  CHECK(state.mean == 0.7);
  CHECK(state.error == 0.0);
  CHECK(state.trend == 0.0);
  CHECK(state.independent_samples == 100.0);
}

TEST_CASE("a series that stays at zero shows nothing, and is not steady", "[steady_state]") {
  const SteadyState state = riesel::assess_steady_state(Series(1000, 0.0));
  CHECK(state.verdict == SteadyVerdict::too_short);
  CHECK(state.independent_samples == 0.0);
  Series moves(1000, 0.0);
  moves[900] = 1e-9;
  CHECK(riesel::assess_steady_state(moves).independent_samples > 0.0);
}

TEST_CASE("an approach without noise that has arrived is steady", "[steady_state]") {
  const SteadyState state = riesel::assess_steady_state(noisy(1000, 0.0, 0.0, 0, approach(200)));
  CHECK(state.verdict == SteadyVerdict::steady);
  CHECK(std::abs(state.mean - 1.0) < 1e-12);
}

TEST_CASE("short series are too short", "[steady_state]") {
  const std::size_t n = GENERATE(0U, 1U, 5U, 9U, 19U);
  CHECK(riesel::assess_steady_state(Series(n, 1.0)).verdict == SteadyVerdict::too_short);
  const SteadyState falling = riesel::assess_steady_state(noisy(n, 0.0, 0.0, 0, free_fall));
  CHECK(falling.verdict == SteadyVerdict::too_short);
  CHECK(std::isfinite(falling.mean));
  CHECK(std::isfinite(falling.error));
}

TEST_CASE("whatever the transient takes, a sample is left", "[steady_state]") {
  for (std::size_t n = 1; n < 300; ++n)
    for (const double part : {0.2, 0.4, 0.5, 0.6}) {
      const Series arrived = noisy(n, 0.0, 0.0, 1, [&](double t) { return t < part ? 9.0 : 1.0; });
      CHECK(riesel::assess_steady_state(arrived).transient_end < n);
    }
}

TEST_CASE("a velocity that is not finite is refused", "[steady_state]") {
  Series series(100, 1.0);
  series[99] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(riesel::assess_steady_state(series), std::invalid_argument);
  CHECK_THROWS_AS(riesel::assess_steady_state(Series{series[99]}), std::invalid_argument);
}

TEST_CASE("free fall accelerates", "[steady_state]") {
  const SteadyState exact = riesel::assess_steady_state(noisy(1000, 0.0, 0.0, 0, free_fall));
  CHECK(exact.verdict == SteadyVerdict::accelerating);
  CHECK(std::abs(exact.trend - 0.001) < 1e-12);
  CHECK(verdicts(free_fall)[SteadyVerdict::accelerating] >= 97);
}

TEST_CASE("without gravity it is by its mean that a growth is large", "[steady_state]") {
  const auto judge = [](double gain) {
    return riesel::assess_steady_state(
               noisy(1000, 0.01, 0.5, 3, [=](double s) { return 12.0 + gain * s; }))
        .verdict;
  };
  CHECK(judge(4.0) == SteadyVerdict::accelerating);
  CHECK(judge(0.4) == SteadyVerdict::drifting);
  CHECK(judge(-4.0) == SteadyVerdict::drifting);
}

TEST_CASE("at high speed a runaway is told by gravity", "[steady_state]") {
  // From 40 to 41 m/s: a small part of the mean, but a third of what free fall would have gained.
  const Series series = noisy(2000, 0.02, 0.9, 1, [](double s) { return 40.0 + s; });
  CHECK(riesel::assess_steady_state(series).verdict == SteadyVerdict::drifting);
  CHECK(riesel::assess_steady_state(series, 3.0 / 2000).verdict == SteadyVerdict::accelerating);
  CHECK(riesel::assess_steady_state(series, 30.0 / 2000).verdict == SteadyVerdict::drifting);
}

TEST_CASE("a flow that breaks away at the end accelerates, however long it was held",
          "[steady_state]") {
  // 3 s at 2 m/s, held until so much of the time has passed, and free fall from there on.
  const double held = GENERATE(0.5, 0.7, 0.8, 0.84);
  const double gravity = 10.0, time = 3.0;
  const auto velocity = [&](double passed) {
    return 2.0 + gravity * time * std::max(0.0, passed - held);
  };
  int accelerating = 0;
  int held_to_the_end = 0;
  for (unsigned seed = 0; seed < runs; ++seed) {
    const auto judge = [&](const std::function<double(double)>& signal) {
      return riesel::assess_steady_state(noisy(300, 0.05, 0.9, seed, signal), gravity * time / 300)
          .verdict;
    };
    accelerating += judge(velocity) == SteadyVerdict::accelerating;
    held_to_the_end += judge([](double) { return 2.0; }) != SteadyVerdict::accelerating;
  }
  CHECK(accelerating >= 99);
  CHECK(held_to_the_end == runs);
}

TEST_CASE("growth at the end by less than half of gravity is no breakaway", "[steady_state]") {
  // Three tenths of free fall in the last sixth of 3 s at 10 m/s^2.
  const auto held = [](double s) { return 20.0 + 0.3 * 10.0 * 3.0 * std::max(0.0, s - 0.84); };
  for (unsigned seed = 0; seed < 20; ++seed)
    CHECK(riesel::assess_steady_state(noisy(300, 0.05, 0.9, seed, held), 10.0 * 3.0 / 300).verdict
          != SteadyVerdict::accelerating);
}

TEST_CASE("slowing down is a drift, however fast", "[steady_state]") {
  const auto decay = [](double s) { return 1.0 + 2.0 * std::exp(-2.0 * s); };
  auto count = verdicts(decay);
  CHECK(count[SteadyVerdict::drifting] >= 80);
  CHECK(count[SteadyVerdict::accelerating] == 0);
  CHECK(count[SteadyVerdict::steady] <= 1);
}

TEST_CASE("an approach that is under way is not steady", "[steady_state]") {
  const double times = GENERATE(1.0, 2.0, 3.0);
  auto count = verdicts(approach(times));
  CHECK(count[SteadyVerdict::accelerating] + count[SteadyVerdict::drifting] >= 90);
  CHECK(count[SteadyVerdict::steady] == 0);
}

TEST_CASE("an approach that ends midway is rather too short than wrong", "[steady_state]") {
  CHECK(verdicts(approach(5))[SteadyVerdict::steady] <= 12);
}

TEST_CASE("an approach that has arrived is steady, and its mean is right", "[steady_state]") {
  int steady = 0;
  int covered = 0;
  for (unsigned seed = 0; seed < runs; ++seed) {
    const SteadyState state =
        riesel::assess_steady_state(noisy(2000, 0.05, 0.9, seed, approach(10)));
    if (state.verdict != SteadyVerdict::steady) continue;
    ++steady;
    covered += std::abs(state.mean - 1.0) <= 2.0 * state.error;
    CHECK(state.transient_end >= 400);  // two T, at which the bias is still 14 %
  }
  CHECK(steady >= 85);
  CHECK(covered >= steady * 85 / 100);
}

TEST_CASE("a stationary series is steady", "[steady_state]") {
  auto count = verdicts(constant);
  CHECK(count[SteadyVerdict::steady] >= 94);
  CHECK(count[SteadyVerdict::accelerating] == 0);
}

TEST_CASE("memory as long as the run is too short", "[steady_state]") {
  int too_short = 0;
  for (unsigned seed = 0; seed < runs; ++seed) {
    const Series series = noisy(1000, 0.05, 0.99, seed, constant);  // five independent samples
    too_short += riesel::assess_steady_state(series).verdict == SteadyVerdict::too_short;
  }
  CHECK(too_short >= 90);
}

TEST_CASE("a random walk is not steady", "[steady_state]") {
  std::mt19937_64 generator(11);
  std::normal_distribution<double> normal;
  int steady = 0;
  for (unsigned run = 0; run < runs; ++run) {
    Series walk(2000);
    double x = 100.0;
    for (double& sample : walk) sample = x += normal(generator);
    steady += riesel::assess_steady_state(walk).verdict == SteadyVerdict::steady;
  }
  CHECK(steady <= 3);
}

TEST_CASE("a flow is as steady as the worst of its series", "[steady_state]") {
  const Series good = noisy(2000, 0.05, 0.9, 1, constant);
  const auto beside = [&](const Series& other) { return riesel::assess_flow({good, {}, {other}}); };
  REQUIRE(beside(good).verdict == SteadyVerdict::steady);
  CHECK_FALSE(beside(good).held_back_by);

  const SteadyState cooling = beside(noisy(2000, 0.05, 0.9, 2, [](double s) { return 2.0 - s; }));
  CHECK(cooling.verdict == SteadyVerdict::drifting);
  CHECK(cooling.held_back_by == 0);
  CHECK(cooling.mean == riesel::assess_steady_state(good).mean);

  const Series slow = noisy(2000, 0.05, 0.995, 3, constant);  // five independent samples
  CHECK(beside(slow).verdict == SteadyVerdict::too_short);
  CHECK(beside(slow).held_back_by == 0);
  CHECK(beside(slow).independent_samples == riesel::assess_steady_state(slow).independent_samples);
}

TEST_CASE("a flow and its mirror image have one state", "[steady_state]") {
  const Series good = noisy(2000, 0.05, 0.9, 1, constant);
  for (const auto& [beside, verdict] :
       {std::pair{noisy(2000, 0.05, 0.9, 2, constant), SteadyVerdict::steady},
        {noisy(2000, 0.05, 0.9, 2, [](double s) { return 2.0 - s; }), SteadyVerdict::drifting},
        {noisy(2000, 0.05, 0.9, 2, free_fall), SteadyVerdict::drifting}}) {
    Series mirrored = beside;
    for (double& sample : mirrored) sample = -sample;
    for (const Series& other : {beside, mirrored})
      CHECK(riesel::assess_flow({good, {}, {other}}).verdict == verdict);
  }
}

TEST_CASE("of several series that hold a flow back the one that drifts is told", "[steady_state]") {
  const Series good = noisy(2000, 0.05, 0.9, 1, constant);
  const Series slow = noisy(2000, 0.05, 0.995, 3, constant);
  const Series cooling = noisy(2000, 0.05, 0.9, 2, [](double s) { return 2.0 - s; });
  const Series cooling_too = noisy(2000, 0.05, 0.9, 4, [](double s) { return 2.0 - s; });
  const auto with = [&](std::vector<std::span<const double>> others) {
    return riesel::assess_flow({good, {}, std::move(others)});
  };
  CHECK_FALSE(with({}).held_back_by);
  CHECK(with({good, slow}).held_back_by == 1);
  CHECK(with({good, slow}).verdict == SteadyVerdict::too_short);
  for (const auto& [state, which] : {std::pair{with({slow, cooling}), 1},
                                     {with({cooling, slow}), 0},
                                     {with({cooling, cooling_too}), 0}}) {
    CHECK(state.held_back_by == which);
    CHECK(state.verdict == SteadyVerdict::drifting);
  }
}

TEST_CASE("the beginning of a flow has that of each of its series", "[steady_state]") {
  const Series a{1.0, 2.0, 3.0}, b{4.0, 5.0, 6.0}, c{7.0, 8.0, 9.0};
  const riesel::FlowSeries begin = riesel::FlowSeries{a, 0.5, {b, c}}.first(2);
  CHECK(begin.judged.size() == 2);
  CHECK(begin.free_fall_gain == 0.5);
  REQUIRE(begin.others.size() == 2);
  for (const auto& [other, whole] : {std::pair{begin.others[0], &b}, {begin.others[1], &c}}) {
    CHECK(other.size() == 2);
    CHECK(other.data() == whole->data());
  }
}

TEST_CASE("growth of the other series makes a flow drift, not run away", "[steady_state]") {
  const Series good = noisy(2000, 0.05, 0.9, 1, constant);
  const Series heating = noisy(2000, 0.05, 0.9, 2, free_fall);
  REQUIRE(riesel::assess_steady_state(heating).verdict == SteadyVerdict::accelerating);
  CHECK(riesel::assess_flow({good, {}, {heating}}).verdict == SteadyVerdict::drifting);
}

TEST_CASE("a constant series, such as the temperature of one grain, holds nothing back",
          "[steady_state]") {
  const Series good = noisy(2000, 0.05, 0.9, 1, constant);
  for (const double value : {0.0, 3.0}) {
    const Series same(2000, value);
    CHECK(riesel::assess_flow({good, {}, {same}}).verdict == SteadyVerdict::steady);
  }
}

TEST_CASE("a flow whose judged series is not steady is judged by it alone", "[steady_state]") {
  const Series good = noisy(2000, 0.05, 0.9, 1, constant);
  const Series falling = noisy(2000, 0.05, 0.9, 2, free_fall);
  const SteadyState state = riesel::assess_flow({falling, {}, {good}});
  CHECK(state.verdict == SteadyVerdict::accelerating);
  CHECK_FALSE(state.held_back_by);
}
