// The command riesel as a function: the program calls it, and so does a program of somebody else
// that adds contact laws and scenarios first (scenarios/scenario.hpp).
#pragma once

namespace riesel::app {

/// Does what the command line says. Returns the exit status; errors are told on stderr.
int command(int argc, char** argv);

}  // namespace riesel::app
