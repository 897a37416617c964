#include "app/commands.hpp"
#include "app/exit_status.hpp"
#include "io/settings_schema.hpp"
#include "scenarios/scenario.hpp"

#include <fmt/core.h>

namespace riesel::app {

int print_schema(bool of_sweeps) {
  const auto& tables = scenarios::settings_tables();
  fmt::print("{}", of_sweeps ? io::sweep_schema(tables) : io::settings_schema(tables));
  return exit_done;
}

}  // namespace riesel::app
