#include "app/command_words.hpp"
#include "app/completion.hpp"
#include "app/exit_status.hpp"
#include "io/build_info.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace riesel::app {

namespace {

/// Escaped for roff: no line begins with a dot or a quote, and hyphens stay as they are.
std::string roff(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '-' || c == '\\') escaped += '\\';
    escaped += c;
  }
  return escaped.starts_with('.') || escaped.starts_with('\'') ? "\\&" + escaped : escaped;
}

std::string section_of_command(const Subcommand& command) {
  std::string places, options;
  for (const CommandWord& place : command.places)
    places += fmt::format(" \\fI{}\\fR", place.names.front());
  for (const CommandWord& option : command.options) {
    const std::string value = option.value.empty() ? "" : fmt::format(" \\fI{}\\fR", option.value);
    options += fmt::format(".TP\n\\fB{}\\fR{}\n{}\n",
                           roff(fmt::format("{}", fmt::join(option.names, ", "))), value,
                           roff(option.meaning));
  }
  return fmt::format(".SS \\fBriesel {}\\fR{} [options]\n{}.\n{}", roff(command.name), places,
                     roff(command.meaning), options);
}

}  // namespace

std::string man_page(const CLI::App& program) {
  std::string commands;
  for (const Subcommand& command : subcommands_of(program)) commands += section_of_command(command);
  return fmt::format(
      ".TH RIESEL 1 \"\" \"riesel {}\" \"User Commands\"\n"
      ".SH NAME\nriesel \\- molecular dynamics of rapid granular flow\n"
      ".SH SYNOPSIS\n.B riesel\n\\fICOMMAND\\fR [\\fIoptions\\fR]\n"
      ".SH DESCRIPTION\n"
      "From a settings file in YAML, riesel runs a simulation of grains that fly, collide and fall "
      "along corrugated walls, and reports the steady\\-state velocity with its error bar, or that "
      "there is none.\n"
      ".PP\nTo begin: \\fBriesel new periodic_tube\\fR, \\fBriesel run periodic_tube.yaml\\fR.\n"
      ".SH COMMANDS\n{}"
      ".SH EXIT STATUS\n"
      ".TP\n.B {}\ndone\n"
      ".TP\n.B {}\nthe run failed, or the system did\n"
      ".TP\n.B {}\nsettings or usage are wrong, or another process has the directory\n"
      ".TP\n.B {}\nout of time (\\-\\-max\\-walltime); the run can be resumed\n"
      ".TP\n.B 129, 130, 143\ninterrupted by a signal; a flow has written a checkpoint\n"
      ".SH ENVIRONMENT\n"
      ".TP\n.B OMP_NUM_THREADS\nThe most threads that run.threads: auto and a sweep take.\n"
      ".TP\n.B NO_COLOR\nIf set, no colours on terminals.\n"
      ".TP\n.B UDUNITS2_XML_PATH\nThe database of units, if not the one of UDUNITS\\-2.\n"
      ".SH SEE ALSO\n\\fBriesel settings\\fR prints the reference of all settings.\n",
      build_info().version, commands, exit_done, exit_failed, exit_bad_input, exit_out_of_time);
}

}  // namespace riesel::app
