#include "app/sweep_plan.hpp"

#include "app/cost.hpp"
#include "app/stepping.hpp"
#include "app/sweep_runner.hpp"
#include "engine/parallel_problems.hpp"
#include "io/sweep_file.hpp"
#include "io/sweep_points.hpp"
#include "scenarios/continued_start.hpp"
#include "scenarios/scenario.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <tuple>
#include <variant>

namespace riesel::app {

namespace {

using scenarios::ColumnCurve;
using scenarios::Flow;
using scenarios::ImpactCurve;
using scenarios::Problem;
using scenarios::problem_of;

/// As problem_of(), but without a look at the run that a flow continues: within a chain that is not
/// known yet.
Problem prepared(const io::Settings& settings) {
  return scenarios::named(settings.scenario()).prepare(settings);
}

/// The amount of work, in a unit that fits the kind of problem: particle-steps, impacts, or falling
/// beads.
double work_of(const io::Settings& settings, const Problem& problem) {
  if (const auto* flow = std::get_if<Flow>(&problem))
    return static_cast<double>(flow->state.grains.size()) * steps_of(settings, *flow);
  if (const auto* column = std::get_if<ColumnCurve>(&problem))
    return static_cast<double>(column->gap_ratios.size()) * column->setup.beads;
  return static_cast<double>(std::get<ImpactCurve>(problem).impacts.size());
}

/// Measured time per unit of work_of(), in s on one thread.
double seconds_per_work(const io::Settings& settings) {
  constexpr double seconds_to_measure = 0.05;
  constexpr std::size_t impacts_to_measure = 20, drops_to_measure = 2;
  const Problem problem = prepared(settings);
  if (const auto* flow = std::get_if<Flow>(&problem))
    return 1.0 / measured_speed(settings, *flow, 1, seconds_to_measure);
  if (const auto* column = std::get_if<ColumnCurve>(&problem))
    return measured_cost(*column, 1, drops_to_measure).seconds / work_of(settings, problem);
  const auto& curve = std::get<ImpactCurve>(problem);
  return measured_cost(curve, 1, impacts_to_measure).seconds / work_of(settings, problem);
}

int most_threads_of(const io::Settings& settings, const Problem& problem) {
  if (const auto* flow = std::get_if<Flow>(&problem))
    return most_threads_for(settings, flow->state.grains.size());
  return most_threads_for_curve(settings);
}

/// Whether a run draws random numbers: not in impacts or drops, nor where grains are given.
bool draws_numbers(const io::Settings& settings, const Problem& problem) {
  constexpr auto kind = "start.kind";
  if (!std::holds_alternative<Flow>(problem)) return false;
  const io::SettingsTable& table = scenarios::settings_tables().at(settings.scenario());
  return !io::has_key(table, kind) || settings.text(kind) == "fresh";
}

/// What a run costs.
struct Cost {
  const io::SweepPoint* point = nullptr;
  double work = 0.0;     // see work_of
  double seconds = 0.0;  // on one thread
  int most_threads = 1;
  bool has_seed = false;                   // whether its result depends on the seed
  std::vector<double> swings_across = {};  // m, of the walls of a flow
};

/// Sorts the runs by work and cuts them into a few groups. Measures one of each, and takes the
/// others of the group to be as fast. The groups are measured side by side, as runs will be done.
void estimate_seconds(std::vector<Cost*> costs) {
  constexpr std::size_t most_measured = 12;
  std::stable_sort(costs.begin(), costs.end(),
                   [](const Cost* a, const Cost* b) { return a->work < b->work; });
  const std::size_t measured = std::min(most_measured, costs.size());
  std::vector<std::span<Cost*>> parts;
  for (std::size_t part = 0; part < measured; ++part) {
    const std::size_t begin = part * costs.size() / measured;
    const std::size_t end = (part + 1) * costs.size() / measured;
    parts.push_back(std::span(costs).subspan(begin, end - begin));
  }
  const std::vector<double> rates = solve_all(parts, cores(), [](const std::span<Cost*>& part) {
    return seconds_per_work(part[part.size() / 2]->point->settings);
  });
  for (std::size_t part = 0; part < measured; ++part)
    for (Cost* const cost : parts[part]) cost->seconds = rates[part] * cost->work;
}

/// Of a point that starts from its neighbour, whose state is not known yet, prepared as if it
/// started like the first of its chain. Throws io::SettingsError.
Problem continued_problem(const io::SweepPoint& point, const std::vector<double>& swings_before) {
  Problem problem = prepared(point.settings);
  scenarios::reject_other_swing_across(point.settings, swings_before,
                                       std::get<Flow>(problem).state);
  return problem;
}

/// By the name of the run. Throws io::SettingsError for settings that cannot be run.
std::map<std::string, Cost> costs_of(const std::vector<io::SweepPoint>& points) {
  std::map<std::string, Cost> costs;
  std::vector<Cost*> in_order;
  for (const io::SweepPoint& point : points) {
    const auto [entry, is_new] = costs.try_emplace(point.name);
    if (!is_new) continue;
    const Problem problem =
        point.parent ? continued_problem(point, costs.at(points[*point.parent].name).swings_across)
                     : problem_of(point.settings);
    entry->second = {.point = &point,
                     .work = work_of(point.settings, problem),
                     .most_threads = most_threads_of(point.settings, problem),
                     .has_seed = draws_numbers(point.settings, problem)};
    if (const auto* flow = std::get_if<Flow>(&problem))
      entry->second.swings_across = scenarios::swings_across(flow->state);
    in_order.push_back(&entry->second);
  }
  estimate_seconds(in_order);
  return costs;
}

io::ManifestPoint row_of(const io::SweepPoint& point, const std::vector<io::SweepPoint>& points,
                         const std::vector<io::VariedSetting>& varied,
                         const std::map<std::string, Cost>& costs) {
  const Cost& cost = costs.at(point.name);
  io::ManifestPoint row = {.name = point.name,
                           .parent = point.parent ? points[*point.parent].name : "",
                           .branch = point.branch,
                           .leg = point.leg,
                           .values = {},
                           .inputs = point.inputs,
                           .expected_seconds = cost.seconds,
                           .most_threads = cost.most_threads,
                           .status = to_string(RunStatus::waiting),
                           .reason = {}};
  for (const auto& setting : varied) row.values.push_back(io::cell_of(point.settings, setting.key));
  return row;
}

void check_continuation(const io::SweepFile& sweep) {
  if (!sweep.continuation) return;
  for (const std::string& key : sweep.axes[sweep.continuation->axis].keys) {
    if (scenarios::can_continue_along(key)) continue;
    throw io::SettingsError(sweep.continuation->place, "continue_along",
                            "runs cannot continue each other along " + key,
                            "choose a setting of contact or run, gravity, or what tilts or moves "
                            "the walls: the neighbour gives the grains, the walls and the start");
  }
}

/// Whether results depend on any key of the axis.
bool matters(const io::SweepAxis& axis, const io::SettingsTable& table) {
  return std::ranges::any_of(table, [&](const io::Setting& row) {
    return row.matters && std::ranges::find(axis.keys, row.key) != axis.keys.end();
  });
}

void reject_axes_in_vain(const io::SweepFile& sweep) {
  for (const io::SweepAxis& axis : sweep.axes)
    if (!matters(axis, scenarios::settings_tables().at(sweep.scenario)))
      throw io::SettingsError(axis.values.front().front().key_place, axis.keys.front(),
                              "changes no result: its runs would be the same",
                              "leave it out, or write one value below 'set:'");
}

/// Where the sweep file asks for several seeds, if it varies the seed alone.
std::optional<io::Place> place_of_seeds(const io::SweepFile& sweep) {
  if (sweep.seeds.size() > 1) return sweep.seeds.front().key_place;
  for (const io::SweepAxis& axis : sweep.axes)
    if (axis.keys == std::vector<std::string>{"seed"} && axis.values.size() > 1)
      return axis.values.front().front().key_place;
  return {};
}

void reject_seeds_in_vain(const io::SweepFile& sweep, const std::map<std::string, Cost>& costs) {
  const auto place = place_of_seeds(sweep);
  const bool any = std::ranges::any_of(costs, [](const auto& c) { return c.second.has_seed; });
  if (place && !any)
    throw io::SettingsError(*place, "seed",
                            "changes no result: no run draws random numbers, so that several seeds "
                            "would give the same several times",
                            "leave it out");
}

/// The unit that a setting has in all points with a value; empty if it is not the same in all.
std::string common_unit(const std::string& key, const std::vector<io::SweepPoint>& points) {
  std::set<std::string> units;
  for (const io::SweepPoint& point : points)
    if (point.settings.has(key)) units.insert(point.settings.unit(key));
  return units.size() == 1 ? *units.begin() : "";
}

std::vector<io::VariedSetting> varied_settings(const io::SweepFile& sweep,
                                               const std::vector<io::SweepPoint>& points) {
  std::vector<io::VariedSetting> varied;
  const io::SettingsTable& table = scenarios::settings_tables().at(sweep.scenario);
  for (const std::string& key : io::varied_keys(sweep, table, points))
    varied.push_back({key, common_unit(key, points)});
  return varied;
}

/// Each point has its values in the manifest, which long lists on an axis make too large to be
/// read.
void reject_huge(const io::Manifest& manifest, const std::filesystem::path& file) {
  const std::size_t size = io::to_json(manifest).size();
  if (size > io::largest_plan)
    throw io::SettingsError({.source = file.string()}, "axes",
                            fmt::format("the list of its {} points with their values takes {} MB, "
                                        "and may take {}",
                                        manifest.points.size(), size / 1'000'000,
                                        io::largest_plan / 1'000'000),
                            "shorten the lists among the values, or split the sweep");
}

}  // namespace

SweepPlan plan_sweep(const std::filesystem::path& file) {
  const io::SettingsTables& tables = scenarios::settings_tables();
  const io::SweepFile sweep = io::read_sweep_file(file, tables);
  check_continuation(sweep);
  reject_axes_in_vain(sweep);
  const std::vector<io::SweepPoint> points = io::expand(sweep, tables);

  SweepPlan plan;
  plan.sweep_file = sweep.text;
  plan.manifest.varied = varied_settings(sweep, points);
  const std::map<std::string, Cost> costs = costs_of(points);
  reject_seeds_in_vain(sweep, costs);
  std::set<std::tuple<std::string, std::string, std::string>> seen;
  for (const io::SweepPoint& point : points) {
    // The same value twice on an axis is one point; the same run in two branches is two.
    if (!seen.emplace(point.name, point.branch, point.leg).second) continue;
    plan.manifest.points.push_back(row_of(point, points, plan.manifest.varied, costs));
    plan.settings.push_back(point.yaml);
  }
  reject_huge(plan.manifest, file);
  return plan;
}

}  // namespace riesel::app
