// How much a run tells of itself. Errors are told in any case.
#pragma once

namespace riesel::app {

enum class Verbosity {
  quiet,   ///< nothing: the files tell
  normal,  ///< how far it is, and its result
  verbose  ///< what it begins with, and each checkpoint, too
};

}  // namespace riesel::app
