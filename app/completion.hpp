// What shells and `man` are told of the command line: made from the table that also reads it.
#pragma once

#include <CLI/App.hpp>

#include <array>
#include <string>

namespace riesel::app {

/// Those for which there is a script.
inline constexpr std::array shells = {"bash", "zsh"};

/// Scripts that complete subcommands, options, files, scenarios and keys of settings.
std::string bash_completion(const CLI::App& program);
std::string zsh_completion(const CLI::App& program);

/// The manual page of the program, in roff.
std::string man_page(const CLI::App& program);

}  // namespace riesel::app
