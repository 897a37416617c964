// How much a run prints. Errors are printed in any case.
#pragma once

namespace riesel::app {

enum class Verbosity {
  quiet,   ///< nothing: results are in the files
  normal,  ///< how far it is, and its result
  verbose  ///< also what it begins with, and each checkpoint
};

}  // namespace riesel::app
