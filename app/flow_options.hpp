// What the command line says about a run, besides its settings.
#pragma once

#include "app/verbosity.hpp"

#include <optional>

namespace riesel::app {

struct FlowOptions {
  Verbosity verbosity = Verbosity::normal;
  bool profile = false;                ///< print where the time went
  std::optional<double> max_walltime;  ///< s of real time since the program started
};

}  // namespace riesel::app
