// What is shown differently to somebody at a terminal: colours, and lines as wide as it is. With
// NO_COLOR in the environment (no-color.org) there are no colours there either.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace riesel::app {

enum class Colour { green = 32, yellow = 33, red = 31 };

/// The text, coloured if standard output is a terminal that takes colours.
std::string coloured(std::string_view text, Colour colour);

/// Columns of the terminal behind standard error; 80 if it does not tell.
std::size_t terminal_width();

}  // namespace riesel::app
