#include "app/print_sweep.hpp"

#include "app/cell_text.hpp"
#include "app/cost.hpp"
#include "app/plain_words.hpp"
#include "app/sweep_directory.hpp"
#include "io/file_error.hpp"
#include "io/summary_reader.hpp"
#include "io/sweep_table.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace riesel::app {

namespace {

/// "contact.restitution=0.9 seed=1 slow forward"
std::string coordinates_of(const io::ManifestPoint& point, const io::Manifest& manifest) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < manifest.varied.size(); ++i) {
    const std::string value = text_of(point.values[i]);
    words.push_back(fmt::format("{}={}", manifest.varied[i].key, value.empty() ? "-" : value));
  }
  for (const std::string* label : {&point.branch, &point.leg})
    if (!label->empty()) words.push_back(*label);
  return fmt::format("{}", fmt::join(words, " "));
}

/// s: the time of all runs divided by the jobs, or that of the longest chain if it is longer. What
/// has failed is run only if it is to be tried again.
double seconds_left(const io::Manifest& manifest, int jobs, bool retry_failed) {
  std::map<std::string, double> until_end;  // s, of a run together with those it waits for
  double all = 0.0, longest = 0.0;
  for (const io::ManifestPoint& point : manifest.points) {
    if (until_end.contains(point.name)) continue;
    const bool is_over = has_status(point, RunStatus::done)
                         || (has_status(point, RunStatus::failed) && !retry_failed);
    const double seconds = is_over ? 0.0 : point.expected_seconds;
    const double before = point.parent.empty() ? 0.0 : until_end[point.parent];
    until_end[point.name] = before + seconds;
    all += seconds;
    longest = std::max(longest, before + seconds);
  }
  return std::max(all / jobs, longest);
}

/// Prints how many of the flows that are done are steady and valid, and what the others are.
void print_verdicts(const io::Manifest& manifest, const std::filesystem::path& sweep) {
  std::map<std::string, int> verdicts;
  for (const io::ManifestPoint& point : manifest.points) {
    if (!has_status(point, RunStatus::done)) continue;
    try {
      const io::Summary any =
          io::read_summary(point_directory(sweep, point.name) / io::summary_name);
      if (const auto* flow = std::get_if<io::FlowSummary>(&any))
        ++verdicts[fmt::format(
            "{} and {}{}", name(flow->state), name(flow->validity.verdict.verdict),
            flow->ended_by == io::EndedBy::at_most ? " (ended at run.until.at_most)" : "")];
    } catch (const io::FileError&) {
      ++verdicts["unreadable"];
    }
  }
  if (!verdicts.empty()) fmt::print("  flows: {}\n", counted(verdicts));
}

}  // namespace

void print_plan(const io::Manifest& manifest, const std::filesystem::path& sweep, int jobs,
                bool retry_failed) {
  std::set<std::string> runs;
  std::size_t index = 0;
  for (const io::ManifestPoint& point : manifest.points) {
    runs.insert(point.name);
    fmt::print("{:>5}  {}  {:>8}  {:<11}  {}\n", index++,
               point_directory(sweep, point.name).string(), readable_time(point.expected_seconds),
               point.status, coordinates_of(point, manifest));
  }
  fmt::print("{}, {}, about {} with {} side by side\n",
             so_many(std::ssize(manifest.points), "point"), so_many(std::ssize(runs), "run"),
             readable_time(seconds_left(manifest, jobs, retry_failed)), so_many(jobs, "run"));
}

void print_status(const io::Manifest& manifest, const std::filesystem::path& sweep) {
  std::map<std::string, int> counts;
  for (const io::ManifestPoint& point : manifest.points) ++counts[point.status];
  std::string summary;
  for (const auto status : {RunStatus::done, RunStatus::running, RunStatus::failed,
                            RunStatus::interrupted, RunStatus::waiting})
    add_count(summary, counts[to_string(status)], to_string(status));
  fmt::print("{}: {}: {}\n", sweep.string(), so_many(std::ssize(manifest.points), "point"),
             summary);
  print_verdicts(manifest, sweep);
  for (const io::ManifestPoint& point : manifest.points)
    if (!point.reason.empty())
      fmt::print("  {} {} ({}): {}\n", point.name, point.status, coordinates_of(point, manifest),
                 point.reason);
  const auto is_to_be_tried = [&](const io::ManifestPoint& point) {
    if (!has_status(point, RunStatus::failed)) return false;
    const std::filesystem::path directory = point_directory(sweep, point.name);
    const bool has_failed_itself = standing_of(directory).status != RunStatus::done
                                   || !io::read_run_record(directory).failure.empty();
    return has_failed_itself && can_begin(directory);
  };
  if (std::ranges::any_of(manifest.points, is_to_be_tried))
    fmt::print("  to run the failed points again{}: '{} --retry-failed'\n",
               has_chains(manifest) ? "" : " (with changes by --set, if any)",
               call_of("sweep", sweep));
  if (std::filesystem::exists(sweep / io::sweep_csv_name))
    fmt::print("  table in {} and {}\n", (sweep / io::sweep_csv_name).string(), io::sweep_h5_name);
}

}  // namespace riesel::app
