#include "app/sweep_plan.hpp"

#include "app/cost.hpp"
#include "app/stepping.hpp"
#include "io/sweep_file.hpp"
#include "io/sweep_points.hpp"
#include "scenarios/continued_start.hpp"
#include "scenarios/scenario.hpp"

#include <algorithm>
#include <numeric>
#include <set>

namespace riesel::app {

namespace {

using scenarios::Flow;
using scenarios::ImpactCurve;
using scenarios::Problem;

Problem problem_of(const io::Settings& settings) {
  Problem problem = scenarios::named(settings.scenario()).prepare(settings);
  if (std::holds_alternative<Flow>(problem)) check_stepping(settings);
  return problem;
}

/// What costs time, in a unit that fits the scenario: particle-steps, or impacts.
double work_of(const io::Settings& settings, const Problem& problem) {
  if (const auto* flow = std::get_if<Flow>(&problem))
    return static_cast<double>(flow->state.grains.size()) * steps_of(settings, *flow);
  return static_cast<double>(std::get<ImpactCurve>(problem).impacts.size());
}

/// s, on one thread.
double seconds_per_work(const io::Settings& settings) {
  constexpr double seconds_to_measure = 0.05;
  constexpr std::size_t impacts_to_measure = 20;
  const Problem problem = problem_of(settings);
  if (const auto* flow = std::get_if<Flow>(&problem))
    return 1.0 / measured_speed(settings, *flow, 1, seconds_to_measure);
  const auto& curve = std::get<ImpactCurve>(problem);
  return measured_cost(curve, 1, impacts_to_measure).seconds / work_of(settings, problem);
}

int most_threads_of(const io::Settings& settings, const Problem& problem) {
  if (const auto* flow = std::get_if<Flow>(&problem))
    return threads_for(settings, flow->state.grains.size());
  return threads_for_curve(settings);
}

/// Measures a few points from the cheapest to the dearest, and takes each other one to be as fast
/// as the nearest of them. `work` of each point on input, s on output.
void estimate_seconds(const std::vector<io::SweepPoint>& points, io::Manifest& manifest,
                      const std::vector<double>& work) {
  constexpr std::size_t most_measured = 12;
  std::vector<std::size_t> by_work(points.size());
  std::iota(by_work.begin(), by_work.end(), std::size_t{0});
  std::stable_sort(by_work.begin(), by_work.end(),
                   [&](auto a, auto b) { return work[a] < work[b]; });
  const std::size_t measured = std::min(most_measured, points.size());
  for (std::size_t part = 0; part < measured; ++part) {
    const std::size_t begin = part * points.size() / measured;
    const std::size_t end = (part + 1) * points.size() / measured;
    const double rate = seconds_per_work(points[by_work[(begin + end) / 2]].settings);
    for (std::size_t i = begin; i < end; ++i)
      manifest.points[by_work[i]].expected_seconds = rate * work[by_work[i]];
  }
}

void check_continuation(const io::SweepFile& sweep) {
  if (!sweep.continuation) return;
  for (const std::string& key : sweep.axes[sweep.continuation->axis].keys) {
    if (scenarios::can_continue_along(key)) continue;
    throw io::SettingsError(sweep.continuation->place, "continue_along",
                            "runs cannot continue each other along " + key,
                            "choose a setting of contact or run, or gravity: the neighbour gives "
                            "the grains, the tube and the start");
  }
}

std::vector<io::VariedSetting> varied_settings(const io::SweepFile& sweep) {
  const io::SettingsTable& table = scenarios::settings_tables().at(sweep.scenario);
  std::vector<io::VariedSetting> varied;
  for (const std::string& key : io::varied_keys(sweep))
    varied.push_back({key, std::find_if(table.begin(), table.end(), [&](auto& row) {
                             return row.key == key;
                           })->unit});
  return varied;
}

}  // namespace

SweepPlan plan_sweep(const std::filesystem::path& file) {
  const io::SettingsTables& tables = scenarios::settings_tables();
  const io::SweepFile sweep = io::read_sweep_file(file, tables);
  check_continuation(sweep);
  const std::vector<io::SweepPoint> points = io::expand(sweep, tables);

  SweepPlan plan;
  plan.sweep_file = sweep.text;
  plan.manifest.varied = varied_settings(sweep);
  std::vector<double> work;
  for (const io::SweepPoint& point : points) {
    const Problem problem = problem_of(point.settings);
    work.push_back(work_of(point.settings, problem));
    io::ManifestPoint row = {.name = point.name,
                             .parent = point.parent ? points[*point.parent].name : "",
                             .branch = point.branch,
                             .leg = point.leg,
                             .values = {},
                             .most_threads = most_threads_of(point.settings, problem),
                             .status = "waiting",
                             .reason = {}};
    for (const auto& setting : plan.manifest.varied)
      row.values.push_back(io::cell_of(point.settings, setting.key));
    plan.manifest.points.push_back(row);
    plan.settings.push_back(point.yaml);
  }
  estimate_seconds(points, plan.manifest, work);
  return plan;
}

}  // namespace riesel::app
