// What the runs of curves (impacts, columns of beads) share: many short problems, computed together
// and written as one table.
#pragma once

#include "app/clock.hpp"
#include "app/exit_status.hpp"
#include "app/print_summary.hpp"
#include "app/run_directory.hpp"
#include "app/stepping.hpp"
#include "app/verbosity.hpp"
#include "io/run_file.hpp"
#include "io/summary.hpp"

#include <cstdint>
#include <numeric>
#include <vector>

namespace riesel::app {

/// A column of the curve in run.h5, and its value at a point.
template <class Point>
struct PointColumn {
  io::Column column;
  double (*value)(const Point&);
};

template <class Point>
void write_points(io::RunFile& file, const std::vector<PointColumn<Point>>& table,
                  const std::vector<Point>& points) {
  std::vector<io::Column> columns;
  for (const auto& [column, value] : table) columns.push_back(column);
  std::vector<std::vector<double>> rows;
  for (const Point& point : points) {
    rows.emplace_back();
    for (const auto& [column, value] : table) rows.back().push_back(value(point));
  }
  file.write_curve(columns, rows);
}

/// Computes the curve and writes its run directory; returns the exit status.
///   follow(threads)             a vector of results, each with its number of `steps`; hash_of()
///                               takes the vector
///   summarise(results)          the summary, its `run` left empty
///   write_table(file, summary)  the curve in run.h5
/// `grains`: the number of moving grains in each problem.
template <class Follow, class Summarise, class WriteTable>
int run_problems(const io::Settings& settings, int grains, const RunDirectory& directory,
                 const Arguments& arguments, Verbosity verbosity, Follow follow,
                 Summarise summarise, WriteTable write_table) {
  const int threads = threads_for_curve(settings);
  const auto provenance = io::collect_provenance({.arguments = arguments,
                                                  .seed = settings.integer("seed"),
                                                  .threads = threads,
                                                  .source = settings.source_text(),
                                                  .settings = settings.effective_yaml()});
  const auto start = Clock::now();
  const auto results = follow(threads);
  const double seconds = seconds_since(start);
  const std::int64_t steps =
      std::accumulate(results.begin(), results.end(), std::int64_t{0},
                      [](std::int64_t sum, const auto& result) { return sum + result.steps; });

  auto summary = summarise(results);
  summary.run = {.scenario = settings.scenario(),
                 .grains = grains,
                 .steps = steps,
                 .state_hash = hash_of(results),
                 .wall_seconds = seconds,
                 .particle_steps_per_second = grains * static_cast<double>(steps) / seconds,
                 .threads = threads};
  // Only now: a curve cannot be resumed, so an interrupted run must not leave a run.h5, which would
  // keep it from being started again.
  auto file = io::RunFile::create(directory.file(io::run_file_name), provenance, {});
  write_table(file, summary);
  file.flush();
  directory.write_summary(io::to_json(summary));
  if (verbosity != Verbosity::quiet) print_summary(summary, directory.path());
  return exit_done;
}

}  // namespace riesel::app
