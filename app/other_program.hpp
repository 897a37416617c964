// Programs of others, such as sbatch: called, waited for, and what they say.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace riesel::app {

struct ProgramEnd {
  int status = 0;      ///< exit status, or 128 + the signal that ended it
  std::string output;  ///< what it printed
};

/// What it complains of goes to stderr as it is, or nowhere.
enum class Complaints { shown, hidden };

/// `arguments` begin with the name of the program, which is looked for in PATH. Nothing if it
/// cannot be started.
std::optional<ProgramEnd> run_other_program(const std::vector<std::string>& arguments,
                                            Complaints complaints);

}  // namespace riesel::app
