#include "app/cost.hpp"

#include "app/clock.hpp"
#include "app/schedule.hpp"
#include "app/stepping.hpp"
#include "engine/observables.hpp"
#include "engine/simulation.hpp"
#include "engine/strips.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <vector>

namespace riesel::app {

namespace {

/// Particle-steps per second, for a run that fails in its first steps: any number does.
constexpr double speed_of_what_fails_at_once = 1e7;

/// At most `sample` of them, evenly spread.
template <class Item>
std::vector<Item> sample_of(const std::vector<Item>& all, std::size_t sample) {
  std::vector<Item> some;
  for (std::size_t i = 0; i < all.size(); i += all.size() / sample + 1) some.push_back(all[i]);
  return some;
}

/// The cost of `all` problems if they are like `some`. solve() returns the results of `some`.
template <class Item, class Solve>
CurveCost cost_of_all(const std::vector<Item>& some, std::size_t all, Solve solve) {
  const auto start = Clock::now();
  double steps = 0.0;
  for (const auto& result : solve(some)) steps += static_cast<double>(result.steps);
  const double scale = static_cast<double>(all) / static_cast<double>(some.size());
  return {.steps = scale * steps, .seconds = scale * seconds_since(start)};
}

}  // namespace

double steps_of(const io::Settings& settings, const scenarios::Flow& flow) {
  return static_cast<double>(Schedule(settings, flow.state.time_step).last_step);
}

double measured_speed(const io::Settings& settings, const scenarios::Flow& flow, int threads,
                      double seconds) {
  Simulation simulation(flow.state, flow.model, threads, stepping_of(settings));
  std::int64_t steps = 0;
  double spent = 0.0;
  try {
    simulation.advance(10);  // caches and threads warm up
    const auto start = Clock::now();
    for (std::int64_t chunk = 10; spent < seconds; chunk *= 2) {
      simulation.advance(chunk);
      steps += chunk;
      spent = seconds_since(start);
    }
  } catch (const RunFailure&) {
    if (steps == 0) return speed_of_what_fails_at_once;
  }
  return static_cast<double>(flow.state.grains.size()) * static_cast<double>(steps) / spent;
}

double seconds_per_row(const scenarios::Flow& flow) {
  constexpr double seconds = 0.02;
  const Strips strips = Strips::of(flow.state);
  const auto start = Clock::now();
  double rows = 0.0, spent = 0.0;
  for (; spent < seconds; ++rows) {
    const Observables now = observe(flow.state);
    sum_over_strips(strips, flow.state, flow.model, {.vx = now.mean_vx, .vy = now.mean_vy});
    spent = seconds_since(start);
  }
  return spent / rows;
}

CurveCost measured_cost(const scenarios::ImpactCurve& curve, int threads, std::size_t sample) {
  return cost_of_all(sample_of(curve.impacts, sample), curve.impacts.size(),
                     [&](const auto& some) { return follow_all(curve.setup, some, threads); });
}

CurveCost measured_cost(const scenarios::ColumnCurve& curve, int threads, std::size_t sample) {
  std::vector<double> gaps = sample_of(curve.gap_ratios, sample);
  for (double& gap : gaps) gap = curve.gap(gap);
  return cost_of_all(gaps, curve.gap_ratios.size(),
                     [&](const auto& some) { return drop_all(curve.setup, some, threads); });
}

std::string readable_time(double seconds) {
  if (seconds < 120.0) return fmt::format("{:.0f} s", std::max(1.0, seconds));
  if (seconds < 7200.0) return fmt::format("{:.0f} min", seconds / 60.0);
  return fmt::format("{:.1f} h", seconds / 3600.0);
}

}  // namespace riesel::app
