#include "app/run_curve.hpp"

#include "app/curve_lines.hpp"
#include "app/run_problems.hpp"

#include <algorithm>
#include <span>

namespace riesel::app {

namespace {

/// Mean over the impacts in which the grain came away from the wall, and their largest overlap; the
/// others are counted.
io::CurvePoint average(const ImpactSetup& setup, const scenarios::ImpactCurve::Point& point,
                       std::span<const ImpactResult> results) {
  io::CurvePoint mean{.v_x = point.v_x, .v_y = point.v_y};
  int away = 0;
  double braking = 0.0, braking_cut_short = 0.0, energy_error = 0.0;
  for (const ImpactResult& r : results) {
    if (r.end == ImpactEnd::passed) ++mean.passed;
    if (r.end == ImpactEnd::stuck) ++mean.stuck;
    if (r.end != ImpactEnd::away) continue;
    ++away;
    mean.dv_x += r.dv_x;
    mean.dv_y += r.dv_y;
    mean.contacts += r.contacts;
    mean.contact_time += r.contact_time;
    mean.cut_short += r.cut_short;
    mean.max_overlap = std::max(mean.max_overlap, r.max_overlap);
    braking += r.braking;
    braking_cut_short += r.braking_cut_short;
    energy_error = std::max(energy_error, r.energy_error);
  }
  for (double* value :
       {&mean.dv_x, &mean.dv_y, &mean.contacts, &mean.contact_time, &mean.cut_short})
    *value /= away;                                           // NaN if no impact counts
  mean.brake_failure_fraction = braking_cut_short / braking;  // NaN if nothing brakes
  const double smaller_radius = std::min(setup.grain_radius, setup.wall_grain_radius);
  const Finding worst =
      judge_impacts(mean.max_overlap / smaller_radius, mean.brake_failure_fraction, energy_error);
  if (away == 0) mean.max_overlap = unknown;
  mean.verdict = worst.verdict;
  if (worst.verdict != Validity::valid) mean.cause = worst.name;
  return mean;
}

void write_curve(io::RunFile& file, const io::CurveSummary& summary) {
  static const std::vector<PointColumn<io::CurvePoint>> table = {
      {{"v_x", "m/s", "Velocity towards the wall before the impact."},
       [](auto& p) { return p.v_x; }},
      {{"v_y", "m/s", "Axial velocity before the impact."}, [](auto& p) { return p.v_y; }},
      {{"dv_x", "m/s", "Velocity away from the wall after the impact plus v_x."},
       [](auto& p) { return p.dv_x; }},
      {{"dv_y", "m/s", "Loss of axial velocity."}, [](auto& p) { return p.dv_y; }},
      {{"contacts", "1", "Number of contacts begun."}, [](auto& p) { return p.contacts; }},
      {{"contact_time", "s", "Sum of the durations of the contacts."},
       [](auto& p) { return p.contact_time; }},
      {{"max_overlap", "m", "Largest overlap of all starts that are in the means."},
       [](auto& p) { return p.max_overlap; }},
      {{"passed", "1", "Starts that went through the wall; not in the means."},
       [](auto& p) { return static_cast<double>(p.passed); }},
      {{"stuck", "1", "Starts that were given up; not in the means."},
       [](auto& p) { return static_cast<double>(p.stuck); }},
      {{"cut_short", "1", "Number of contacts cut short."}, [](auto& p) { return p.cut_short; }},
      {{"brake_failure_fraction", "1", "Share of the braking that is done by contacts cut short."},
       [](auto& p) { return p.brake_failure_fraction; }},
      {{"verdict", "1", "Validity: 0 valid, 1 suspect, 2 unphysical."},
       [](auto& p) { return static_cast<double>(p.verdict); }},
  };
  write_points(file, table, summary.curve);
}

}  // namespace

int run_curve(const io::Settings& settings, const scenarios::ImpactCurve& curve,
              const RunDirectory& directory, const Arguments& arguments, Verbosity verbosity) {
  const auto summarise = [&](const std::vector<ImpactResult>& results) {
    io::CurveSummary summary;
    for (const auto& point : curve.points)
      summary.curve.push_back(average(
          curve.setup, point, std::span(results).subspan(point.first_impact, point.impacts)));
    summary.lines = lines_of(summary.curve);
    return summary;
  };
  return run_problems(
      settings, 1, directory, arguments, verbosity,
      [&](int threads) { return follow_all(curve.setup, curve.impacts, threads); }, summarise,
      write_curve);
}

}  // namespace riesel::app
