// The words of the command line, as those want them who write about it.
#pragma once

#include <CLI/App.hpp>

#include <string>
#include <vector>

namespace riesel::app {

/// What stands at a place of the command line.
enum class WordKind { flag, file, directory, scenario, key, shell, other };

struct CommandWord {
  std::vector<std::string> names;  ///< "--out"; of what is known by its place "FILE"
  std::string value;               ///< "DIR"; empty if it takes none
  std::string meaning;
  WordKind kind;
};

struct Subcommand {
  std::string name, meaning;
  std::vector<CommandWord> places;   ///< in their order
  std::vector<CommandWord> options;  ///< with --help
};

std::vector<Subcommand> subcommands_of(const CLI::App& program);

/// What may stand after --set, and scenarios.
std::vector<std::string> keys_of_settings();
std::vector<std::string> names_of_scenarios();

}  // namespace riesel::app
