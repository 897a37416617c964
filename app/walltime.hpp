// The real time that a run may take: batch systems kill jobs that take longer.
#pragma once

#include <string>

namespace riesel::app {

/// s of real time since this program started.
double seconds_since_start_of_program();

/// The time, in s, that a text such as "23.5 h" or "600" (seconds) means. Throws UnusableInput if
/// it is no time above 0.
double read_walltime(const std::string& text);

}  // namespace riesel::app
