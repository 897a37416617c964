#include "app/completion.hpp"

#include "app/command_words.hpp"
#include "io/settings_table.hpp"
#include "scenarios/scenario.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace riesel::app {

namespace {

// --- bash ---

/// The shell command that puts the possible words of this kind into COMPREPLY.
std::string bash_reply(WordKind kind) {
  switch (kind) {
  case WordKind::file:
    return "_riesel_reply -f; compopt -o filenames 2>/dev/null";
  case WordKind::directory:
    return "_riesel_reply -d; compopt -o filenames 2>/dev/null";
  case WordKind::scenario:
    return fmt::format("_riesel_reply -W \"{}\"",
                       fmt::join(io::names_of_scenarios(scenarios::settings_tables()), " "));
  case WordKind::key:
    return "_riesel_reply -S = -W \"$keys\"; compopt -o nospace 2>/dev/null";
  case WordKind::shell:
    return fmt::format("_riesel_reply -W \"{}\"", fmt::join(shells, " "));
  default:
    return "COMPREPLY=()";
  }
}

std::string bash_case(const Subcommand& command) {
  std::string after, words;
  for (const CommandWord& option : command.options) {
    words += fmt::format("{} ", fmt::join(option.names, " "));
    if (option.kind != WordKind::flag)
      after += fmt::format("        {}) {}; return ;;\n", fmt::join(option.names, "|"),
                           bash_reply(option.kind));
  }
  // The kind of the first place stands for all: commands have only one, or the others are easy to
  // type.
  const std::string place =
      bash_reply(command.places.empty() ? WordKind::other : command.places.front().kind);
  return fmt::format("    {}) case $before in\n{}      esac\n"
                     "      if [[ $word == -* ]]; then _riesel_reply -W \"{}\"\n"
                     "      else {}; fi ;;\n",
                     command.name, after, words, place);
}

// --- zsh ---

/// Escaped for use within single quotes, where brackets and colons have a meaning.
std::string zsh_text(const std::string& text) {
  std::string quoted;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':') quoted += '\\';
    quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return quoted;
}

std::string zsh_action(WordKind kind) {
  switch (kind) {
  case WordKind::file:
    return "_files";
  case WordKind::directory:
    return "_files -/";
  case WordKind::scenario:
    return fmt::format("({})",
                       fmt::join(io::names_of_scenarios(scenarios::settings_tables()), " "));
  case WordKind::key:
    return "_values -S = key $keys";
  case WordKind::shell:
    return fmt::format("({})", fmt::join(shells, " "));
  default:
    return " ";
  }
}

std::string zsh_case(const Subcommand& command) {
  std::string words;
  for (const CommandWord& option : command.options)
    for (const std::string& name : option.names) {
      words += fmt::format(" \\\n        '*{}[{}]", name, zsh_text(option.meaning));
      if (option.kind != WordKind::flag)
        words += fmt::format(":{}:{}", option.value, zsh_action(option.kind));
      words += "'";
    }
  for (const CommandWord& place : command.places)
    words += fmt::format(" \\\n        ':{}:{}'", place.names.front(), zsh_action(place.kind));
  return fmt::format("    {}) _arguments{} ;;\n", command.name, words);
}

}  // namespace

std::string bash_completion(const CLI::App& program) {
  std::string names, cases;
  for (const Subcommand& command : subcommands_of(program)) {
    names += command.name + " ";
    cases += bash_case(command);
  }
  return fmt::format(
      "# Completion of riesel for bash: eval \"$(riesel completion bash)\"\n"
      "_riesel_reply() {{ mapfile -t COMPREPLY < <(compgen \"$@\" -- \"$word\"); }}\n"
      "_riesel() {{\n"
      "  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}}\n"
      "  local keys=\"{}\"\n"
      "  if ((COMP_CWORD == 1)); then\n"
      "    _riesel_reply -W \"{}--help --version\"\n"
      "    return\n"
      "  fi\n"
      "  case ${{COMP_WORDS[1]}} in\n{}  esac\n"
      "}}\n"
      "complete -F _riesel riesel\n",
      fmt::join(keys_of_settings(), " "), names, cases);
}

std::string zsh_completion(const CLI::App& program) {
  std::string names, cases;
  for (const Subcommand& command : subcommands_of(program)) {
    names += fmt::format("    '{}:{}'\n", command.name, zsh_text(command.meaning));
    cases += zsh_case(command);
  }
  return fmt::format(
      "#compdef riesel\n"
      "# Completion of riesel for zsh: source <(riesel completion zsh)\n"
      "_riesel() {{\n"
      "  local -a commands keys\n"
      "  keys=({})\n"
      "  commands=(\n{}  )\n"
      "  if ((CURRENT == 2)); then _describe command commands; return; fi\n"
      "  local command=$words[2]\n"
      "  shift words; ((CURRENT--))\n"
      "  case $command in\n{}  esac\n"
      "}}\n"
      "if [[ $funcstack[1] == _riesel ]]; then _riesel \"$@\"; else compdef _riesel riesel; fi\n",
      fmt::join(keys_of_settings(), " "), names, cases);
}

}  // namespace riesel::app
