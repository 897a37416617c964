// Shell completion and the manual page, made from the same description that parses the command
// line, so that they cannot disagree with it.
#pragma once

#include <CLI/App.hpp>

#include <array>
#include <string>

namespace riesel::app {

/// The shells for which there is a completion script.
inline constexpr std::array shells = {"bash", "zsh"};

/// Scripts that complete subcommands, options, files, scenarios and keys of settings.
std::string bash_completion(const CLI::App& program);
std::string zsh_completion(const CLI::App& program);

/// The manual page of the program, in roff.
std::string man_page(const CLI::App& program);

}  // namespace riesel::app
