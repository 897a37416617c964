#include "app/cost.hpp"

#include "app/schedule.hpp"
#include "app/stepping.hpp"
#include "engine/simulation.hpp"

#include <fmt/core.h>
#include <omp.h>

#include <algorithm>
#include <chrono>
#include <vector>

namespace riesel::app {

namespace {

using Clock = std::chrono::steady_clock;

/// Particle-steps per second: any number does for a run that will not last.
constexpr double speed_of_what_fails_at_once = 1e7;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
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

int threads_for_curve(const io::Settings& settings) {
  const auto wanted = settings.integer_or_auto("run.threads");
  return wanted ? static_cast<int>(*wanted) : omp_get_max_threads();
}

CurveCost measured_cost(const scenarios::ImpactCurve& curve, int threads, std::size_t sample) {
  const std::size_t stride = curve.impacts.size() / sample + 1;
  std::vector<Impact> impacts;
  for (std::size_t i = 0; i < curve.impacts.size(); i += stride)
    impacts.push_back(curve.impacts[i]);

  const auto start = Clock::now();
  double steps = 0.0;
  for (const ImpactResult& result : follow_all(curve.setup, impacts, threads))
    steps += static_cast<double>(result.steps);
  const double scale =
      static_cast<double>(curve.impacts.size()) / static_cast<double>(impacts.size());
  return {.steps = scale * steps, .seconds = scale * seconds_since(start)};
}

CurveCost measured_cost(const scenarios::ColumnCurve& curve, int threads, std::size_t sample) {
  const std::size_t stride = curve.gap_ratios.size() / sample + 1;
  std::vector<double> gaps;
  for (std::size_t i = 0; i < curve.gap_ratios.size(); i += stride)
    gaps.push_back(curve.gap(curve.gap_ratios[i]));

  const auto start = Clock::now();
  double steps = 0.0;
  for (const ColumnResult& result : drop_all(curve.setup, gaps, threads))
    steps += static_cast<double>(result.steps);
  const double scale =
      static_cast<double>(curve.gap_ratios.size()) / static_cast<double>(gaps.size());
  return {.steps = scale * steps, .seconds = scale * seconds_since(start)};
}

std::string readable_time(double seconds) {
  if (seconds < 120.0) return fmt::format("{:.0f} s", std::max(1.0, seconds));
  if (seconds < 7200.0) return fmt::format("{:.0f} min", seconds / 60.0);
  return fmt::format("{:.1f} h", seconds / 3600.0);
}

}  // namespace riesel::app
