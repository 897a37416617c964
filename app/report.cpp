// riesel report: the directory of a run that is over, or of a sweep, becomes a page with figures.
#include "app/commands.hpp"
#include "app/exit_status.hpp"
#include "app/plain_words.hpp"
#include "app/report_column.hpp"
#include "app/report_flow.hpp"
#include "app/report_impacts.hpp"
#include "app/report_sweep.hpp"
#include "app/sweep_directory.hpp"
#include "io/directory_lock.hpp"
#include "io/durable_file.hpp"
#include "io/file_error.hpp"
#include "io/settings_text.hpp"
#include "io/summary_reader.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <system_error>
#include <variant>

namespace riesel::app {

namespace {

namespace fs = std::filesystem;

/// What to do about a run without a result.
std::string way_on_with(const fs::path& directory) {
  if (io::DirectoryLock::is_held(directory)) return "wait until it has";
  if (has_checkpoint(directory)) return "go on with it by '" + call_of("resume", directory) + "'";
  return "as it has no checkpoint to go on from, remove it and start the run again";
}

void require_finished_run(const fs::path& directory) {
  if (!fs::exists(directory / io::run_file_name))
    throw UnusableInput(directory.string()
                        + ": holds no run and no sweep; give the directory of one (see '"
                        + call_of("run") + "' and '" + call_of("sweep") + "')");
  if (fs::exists(directory / io::summary_name)) return;
  const std::string way_on = way_on_with(directory);
  const std::string no_end = directory.string() + ": its run has not finished; ";
  if (!fs::exists(directory / post_mortem_name)) throw UnusableInput(no_end + way_on);
  // The failure may be an old one: the run may have been resumed since, and stopped again.
  throw UnusableInput(no_end + "it failed, and its state at that moment is in "
                      + (directory / post_mortem_name).string()
                      + ", from which another run can start (start: {kind: continued, from: ...}); "
                        "if it has been resumed since, "
                      + way_on);
}

Report report_of(const io::FlowSummary& summary, const std::string& effective_settings,
                 const fs::path& run_file) {
  FlowRecord record{.summary = summary,
                    .run = io::read_run_file(run_file),
                    .effective_settings = effective_settings};
  const auto& state = record.run.final_state;
  if (state.step != record.summary.run.steps
      || static_cast<std::int64_t>(state.grains.size()) != record.summary.run.grains)
    throw UnusableInput(run_file.string()
                        + ": is of another run than summary.json beside it; restore the file that "
                          "belongs to it");
  try {
    return make_report(record);
  } catch (const std::out_of_range& error) {
    throw UnusableInput(run_file.string() + ": " + error.what()
                        + "; make the run again with this version of riesel");
  }
}

Report report_of(const io::CurveSummary& summary, const std::string& effective_settings,
                 const fs::path& run_file) {
  return make_report(ImpactRecord{.summary = summary,
                                  .history = io::read_run_history(run_file),
                                  .effective_settings = effective_settings});
}

Report report_of(const io::ColumnSummary& summary, const std::string& effective_settings,
                 const fs::path& run_file) {
  return make_report(ColumnRecord{.summary = summary,
                                  .history = io::read_run_history(run_file),
                                  .effective_settings = effective_settings});
}

Report report_of_run(const fs::path& directory) {
  const io::Summary summary = io::read_summary(directory / io::summary_name);
  const std::string settings = io::read_kept_text(directory / io::effective_settings_name);
  return std::visit(
      [&](const auto& known) { return report_of(known, settings, directory / io::run_file_name); },
      summary);
}

SweepResult result_of(const io::ManifestPoint& point, const fs::path& sweep) {
  const fs::path directory = point_directory(sweep, point.name);
  std::error_code out_of_reach;
  SweepResult result{.summary = std::nullopt,
                     .flaw = "",
                     .directory = point_directory("", point.name).generic_string(),
                     .has_report = fs::exists(directory / report_name, out_of_reach)};
  if (!has_status(point, RunStatus::done)) return result;
  try {
    result.summary = io::read_summary(directory / io::summary_name);
  } catch (const io::FileError& error) {
    result.flaw = error.what();
  }
  return result;
}

Report report_of_sweep(const fs::path& directory) {
  SweepRecord record{.manifest = io::read_manifest(directory),
                     .results = {},
                     .sweep_file = io::read_kept_text(directory / sweep_file_name)};
  refresh(record.manifest, directory);
  note_misplaced(record.manifest, directory);
  for (const io::ManifestPoint& point : record.manifest.points)
    record.results.push_back(result_of(point, directory));
  if (std::ranges::none_of(record.results, [](const auto& r) { return r.summary.has_value(); }))
    throw UnusableInput(directory.string() + ": has no point with a result; see '"
                        + call_of("status", directory) + "', and run the sweep to its end");
  return make_report(record);
}

fs::path file_of(const ReportFigure& figure, const fs::path& figures) {
  return figures / (figure.name + ".svg");
}

/// Throws UnusableInput if a file that riesel has not written would be overwritten.
void reject_files_of_others(const Report& report, const fs::path& directory) {
  const auto reject = [](const fs::path& file) {
    throw UnusableInput(file.string()
                        + ": was not written by riesel, and would be overwritten; rename it");
  };
  const fs::path page = directory / report_name;
  if (fs::exists(page) && !is_own_report(page)) reject(page);
  for (const ReportFigure& figure : report.figures) {
    const fs::path file = file_of(figure, directory / figures_name);
    if (fs::exists(file) && !is_own_drawing(file)) reject(file);
  }
}

/// Writes the page last, so that a page always has its figures.
void write(const Report& report, const fs::path& directory) {
  const fs::path figures = directory / figures_name;
  std::error_code error;
  if (fs::is_symlink(figures, error))
    throw io::FileError(figures, "is a link to another place", "remove it");
  reject_files_of_others(report, directory);
  io::make_directories(figures);
  std::vector<std::string> names;
  for (const ReportFigure& figure : report.figures) {
    io::write_durably(file_of(figure, figures), figure.svg.file());
    names.push_back(figure.name);
  }
  remove_own_drawings(figures, names);
  io::write_durably(directory / report_name, report.page);
}

void report_on_run(const fs::path& directory) {
  require_finished_run(directory);
  const auto lock = as_input<io::InUse>([&] { return io::DirectoryLock(directory); });
  write(as_input([&] { return report_of_run(directory); }), directory);
}

}  // namespace

int report(const fs::path& directory) {
  if (fs::exists(directory / io::manifest_name))  // also while the sweep runs
    write(as_input([&] { return report_of_sweep(directory); }), directory);
  else
    report_on_run(directory);
  fmt::print("{}\n", (directory / report_name).string());
  return exit_done;
}

}  // namespace riesel::app
