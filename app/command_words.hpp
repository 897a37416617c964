// The words of the command line, as completion scripts and the manual page need them.
#pragma once

#include <CLI/App.hpp>

#include <string>
#include <vector>

namespace riesel::app {

/// What a word of the command line stands for.
enum class WordKind { flag, file, directory, scenario, key, shell, other };

struct CommandWord {
  std::vector<std::string> names;  ///< "--out"; for a positional argument "FILE"
  std::string value;               ///< "DIR"; empty if it takes no value
  std::string meaning;
  WordKind kind;
};

struct Subcommand {
  std::string name, meaning;
  std::vector<CommandWord> places;   ///< positional arguments, in order
  std::vector<CommandWord> options;  ///< --help included
};

std::vector<Subcommand> subcommands_of(const CLI::App& program);

/// The keys that --set takes: those of all scenarios, sorted, each once.
std::vector<std::string> keys_of_settings();

}  // namespace riesel::app
