// What the command line says about a run, besides its settings.
#pragma once

#include "app/verbosity.hpp"

#include <optional>

namespace riesel::app {

struct FlowOptions {
  Verbosity verbosity = Verbosity::normal;
  bool profile = false;                ///< tell where the time went
  std::optional<double> max_walltime;  ///< s on the clock, to stop before; from the program's start
};

}  // namespace riesel::app
