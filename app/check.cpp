// riesel check: what a settings file means, before hours are spent on it.
#include "app/check_column.hpp"
#include "app/check_flow.hpp"
#include "app/check_impacts.hpp"
#include "app/commands.hpp"
#include "app/exit_status.hpp"
#include "scenarios/scenario.hpp"

#include <fmt/core.h>

#include <variant>

namespace riesel::app {

int check(const CheckOptions& options) {
  const auto settings =
      io::Settings::from_file(options.file, scenarios::settings_tables(), options.overrides);
  const scenarios::Problem problem = scenarios::problem_of(settings);
  fmt::print("{}: {}\n", options.file.string(), settings.scenario());
  if (const auto* flow = std::get_if<scenarios::Flow>(&problem))
    check_flow(settings, *flow);
  else if (const auto* column = std::get_if<scenarios::ColumnCurve>(&problem))
    check_column(settings, *column);
  else
    check_impacts(settings, std::get<scenarios::ImpactCurve>(problem));
  return exit_done;
}

}  // namespace riesel::app
