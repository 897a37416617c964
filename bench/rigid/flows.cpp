#include "bench/rigid/flows.hpp"

#include "bench/output_place.hpp"
#include "bench/rigid/rigid_record.hpp"
#include "io/build_info.hpp"
#include "io/durable_file.hpp"
#include "io/settings.hpp"
#include "scenarios/scenario.hpp"

#include <fmt/core.h>

#include <cmath>
#include <exception>
#include <stdexcept>
#include <variant>

namespace riesel::bench {

namespace {

constexpr double between_rows = 10e-3;  // s

struct Point {
  double restitution, start, shortest_interval;
  int seed;
};

std::vector<Point> points(const FlowsOptions& options) {
  std::vector<Point> all;
  for (const double restitution : options.restitutions)
    for (const double start : options.starts)
      for (const double interval : options.shortest_intervals)
        for (int seed = 1; seed <= options.seeds; ++seed)
          all.push_back({.restitution = restitution,
                         .start = start,
                         .shortest_interval = interval,
                         .seed = seed});
  return all;
}

io::Settings settings_of(const FlowsOptions& options, const Point& point) {
  std::vector<std::string> all = options.overrides;
  all.push_back(fmt::format("contact.restitution={}", point.restitution));
  all.push_back(fmt::format("start.axial_velocity={}", point.start));
  all.push_back(fmt::format("seed={}", point.seed));
  return io::Settings::from_file(options.settings, scenarios::settings_tables(), all);
}

void reject_mistakes(const io::Settings& settings) {
  if (!std::holds_alternative<scenarios::Flow>(scenarios::problem_of(settings)))
    settings.reject("scenario", "is no flow", "choose periodic_tube");
}

/// A row of the table.
std::string run(const FlowsOptions& options, const Point& point) {
  const io::Settings settings = settings_of(options, point);
  const auto flow = std::get<scenarios::Flow>(scenarios::problem_of(settings));
  RigidFlow rigid(flow.state, flow.model, point.shortest_interval);
  RigidRecord record(rigid, between_rows);
  const auto rows = std::lround(settings.number("run.duration") / between_rows);
  for (long row = 0; row < rows; ++row) {
    rigid.advance(between_rows);
    record.add(rigid);
  }
  return fmt::format("{},{},{},{},{},{},{},{}\n", point.restitution, point.start,
                     point.shortest_interval, point.seed, rigid.size(),
                     static_cast<double>(rows) * between_rows, record.columns(flow.state.gravity.y),
                     build_info().git_commit.substr(0, 7));
}

}  // namespace

void run_flows(const FlowsOptions& options) {
  const std::vector<Point> all = points(options);
  for (const Point& point : all) reject_mistakes(settings_of(options, point));
  reject_unfit_place(options.out);
  std::vector<std::string> rows(all.size());
  std::vector<std::string> failures(all.size());
#pragma omp parallel for schedule(dynamic, 1)
  for (std::size_t i = 0; i < all.size(); ++i) {
    try {
      rows[i] = run(options, all[i]);
      fmt::print(stderr, "{}", rows[i]);
    } catch (const std::exception& error) {
      failures[i] = error.what();
    }
  }
  std::string table =
      fmt::format("e_n,start,shortest_interval,seed,grains,time,{},commit\n", RigidRecord::names);
  for (const std::string& row : rows) table += row;
  io::write_durably(options.out, table);
  for (const std::string& failure : failures)  // beside the rows of all others
    if (!failure.empty()) throw std::runtime_error(failure);
}

}  // namespace riesel::bench
