// What the command line says about the running of a flow, besides its settings.
#pragma once

#include <optional>

namespace riesel::app {

struct FlowOptions {
  bool profile = false;                ///< tell where the time went
  std::optional<double> max_walltime;  ///< s on the clock, to stop before; from the program's start
};

}  // namespace riesel::app
