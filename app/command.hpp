// The command riesel as a function: called by the program itself, and by other programs that first
// add contact laws and scenarios of their own (scenarios/scenario.hpp).
#pragma once

namespace riesel::app {

/// Does what the command line says. Returns the exit status; errors are reported on stderr.
int command(int argc, char** argv);

}  // namespace riesel::app
