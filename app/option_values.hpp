// What values options may have, for CLI::Option::transform().
#pragma once

#include <CLI/CLI.hpp>

#include <cstddef>

namespace riesel::app {

/// Takes decimal digits only, from `low` to `high`, also with zeros in front, as `seq -w` prints
/// them: CLI11 itself takes 010 for 8, as C does.
CLI::Validator whole_number(std::size_t low, std::size_t high);

/// Of a file or directory: any name but none.
CLI::Validator some_name();

}  // namespace riesel::app
