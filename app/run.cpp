#include "app/commands.hpp"
#include "app/run_column.hpp"
#include "app/run_curve.hpp"
#include "app/run_flow.hpp"
#include "io/summary.hpp"
#include "scenarios/scenario.hpp"

#include <filesystem>
#include <system_error>

namespace riesel::app {

namespace fs = std::filesystem;

namespace {

/// Rejects options that only flows obey.
void reject_flow_options(const FlowOptions& options, const std::string& scenario) {
  if (options.max_walltime)
    throw UnusableInput("--max-walltime: has no effect on the scenario " + scenario
                        + ", which cannot be resumed; remove it");
  if (options.profile)
    throw UnusableInput("--profile: has no effect on the scenario " + scenario
                        + ", which is no flow; remove it");
}

/// Also if the file is as riesel writes it, as the results would be written over it.
void reject_place_of_input(const fs::path& file, const fs::path& place) {
  std::error_code ignored;
  if (fs::equivalent(file, place / io::effective_settings_name, ignored))
    throw UnusableInput(file.string()
                        + ": would be overwritten, as the results have a file of this name; "
                          "rename it, or choose another directory with --out");
}

}  // namespace

int run(const RunOptions& options, const Arguments& arguments) {
  const auto settings =
      io::Settings::from_file(options.file, scenarios::settings_tables(), options.overrides);
  scenarios::Problem problem = scenarios::problem_of(settings);
  if (!std::holds_alternative<scenarios::Flow>(problem))
    reject_flow_options(options.flow, settings.scenario());
  const fs::path place =
      options.directory ? *options.directory : place_named_after(options.file, "runs");
  reject_place_of_input(options.file, place);
  RunDirectory directory = RunDirectory::create(place, settings);

  if (auto* flow = std::get_if<scenarios::Flow>(&problem))
    return run_flow(settings, std::move(*flow), std::move(directory), arguments, options.flow);
  const Verbosity verbosity = options.flow.verbosity;
  if (const auto* column = std::get_if<scenarios::ColumnCurve>(&problem))
    return run_column(settings, *column, directory, arguments, verbosity);
  return run_curve(settings, std::get<scenarios::ImpactCurve>(problem), directory, arguments,
                   verbosity);
}

}  // namespace riesel::app
