// The time on the clock that a run may take: batch systems kill what takes longer.
#pragma once

#include <string>

namespace riesel::app {

/// s, since this program was started.
double seconds_since_start_of_program();

/// The time that a text such as "23.5 h" or "600" (seconds) means: s. Throws UnusableInput if it
/// means none.
double read_walltime(const std::string& text);

}  // namespace riesel::app
