// riesel report: the directory of a flow that is over becomes a page with figures.
#include "app/commands.hpp"
#include "app/exit_status.hpp"
#include "app/report_page.hpp"
#include "io/directory_lock.hpp"
#include "io/durable_file.hpp"
#include "io/file_error.hpp"
#include "io/settings_text.hpp"
#include "io/summary_reader.hpp"
#include "io/sweep_manifest.hpp"

#include <fmt/core.h>

#include <cstdint>
#include <stdexcept>
#include <system_error>

namespace riesel::app {

namespace {

namespace fs = std::filesystem;

constexpr auto page_name = "report.html";
constexpr auto figures_name = "figures";

void require_finished_run(const fs::path& directory) {
  if (fs::exists(directory / io::manifest_name))
    throw UnusableInput(directory.string()
                        + ": holds a sweep, and reports are made of single runs so far; give one "
                          "of the directories in its points/");
  if (!fs::exists(directory / io::run_file_name))
    throw UnusableInput(directory.string()
                        + ": holds no run; give the directory of a run (see 'riesel run')");
  if (!fs::exists(directory / io::summary_name))
    throw UnusableInput(directory.string() + ": its run has not come to its end; "
                        + (io::DirectoryLock::is_held(directory)
                               ? "wait until it has"
                               : "go on with it by 'riesel resume " + directory.string() + "'"));
}

FlowRecord read_record(const fs::path& directory) {
  FlowRecord record{.summary = io::read_flow_summary(directory / io::summary_name),
                    .run = io::read_run_file(directory / io::run_file_name),
                    .effective_settings =
                        io::read_settings_text(directory / io::effective_settings_name)};
  const auto& state = record.run.final_state;
  if (state.step != record.summary.run.steps
      || static_cast<std::int64_t>(state.grains.size()) != record.summary.run.grains)
    throw UnusableInput((directory / io::run_file_name).string()
                        + ": is of another run than summary.json beside it; restore the file that "
                          "belongs to it");
  return record;
}

Report report_of(const fs::path& directory) {
  try {
    return make_report(read_record(directory));
  } catch (const io::FileError& error) {
    throw UnusableInput(error.what());
  } catch (const std::out_of_range& error) {
    throw UnusableInput((directory / io::run_file_name).string() + ": " + error.what()
                        + "; make the run again with this version of riesel");
  }
}

/// The page last: where it is, its figures are, too.
void write(const Report& report, const fs::path& directory) {
  const fs::path figures = directory / figures_name;
  std::error_code error;
  fs::create_directories(figures, error);
  if (error) throw io::system_failure(figures, "cannot be made", error.value());
  for (const ReportFigure& figure : report.figures)
    io::write_durably(figures / (figure.name + ".svg"), figure.svg.file());
  io::write_durably(directory / page_name, report.page);
}

}  // namespace

int report(const fs::path& directory) {
  require_finished_run(directory);
  const io::DirectoryLock lock(directory);
  const Report made = report_of(directory);
  write(made, directory);
  fmt::print("{}\n", (directory / page_name).string());
  return exit_done;
}

}  // namespace riesel::app
