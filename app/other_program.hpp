// Calling other programs, such as sbatch, and reading what they print.
#pragma once

#include "app/child_process.hpp"

#include <optional>
#include <string>
#include <vector>

namespace riesel::app {

struct ProgramEnd {
  ProcessEnd how;
  std::string output;  ///< what it printed on standard output
};

/// Whether the program's standard error goes to this one's, or nowhere.
enum class Complaints { shown, hidden };

/// Runs a program to its end. `arguments` begin with its name, which is looked up in PATH. Nothing
/// if it cannot be started, or if its end cannot be learned.
std::optional<ProgramEnd> run_other_program(const std::vector<std::string>& arguments,
                                            Complaints complaints);

}  // namespace riesel::app
