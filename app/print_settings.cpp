#include "app/commands.hpp"
#include "app/exit_status.hpp"
#include "io/settings_reference.hpp"
#include "scenarios/scenario.hpp"

#include <fmt/core.h>

namespace riesel::app {

int print_settings() {
  fmt::print("{}", io::settings_reference(scenarios::settings_tables()));
  return exit_done;
}

}  // namespace riesel::app
