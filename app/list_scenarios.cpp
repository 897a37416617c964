#include "app/commands.hpp"
#include "app/exit_status.hpp"
#include "scenarios/scenario.hpp"

#include <fmt/core.h>

namespace riesel::app {

int list_scenarios() {
  for (const scenarios::Scenario& scenario : scenarios::all())
    fmt::print("{:<20}{}\n", scenario.name, scenario.summary);
  return exit_done;
}

}  // namespace riesel::app
