// What is shown to somebody at a terminal: messages, and what is different there, colours and lines
// as wide as it is. With NO_COLOR in the environment (no-color.org) there are no colours there
// either.
#pragma once

#include <fmt/core.h>

#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

namespace riesel::app {

enum class Colour { green = 32, yellow = 33, red = 31 };

/// The text, coloured if standard output is a terminal that takes colours.
std::string coloured(std::string_view text, Colour colour);

/// Writes to standard error, for whoever reads it still: a run goes on though its reader has gone,
/// or the disk of its log is full.
template <class... Parts>
void tell(fmt::format_string<Parts...> format, Parts&&... parts) {
  const std::string text = fmt::format(format, std::forward<Parts>(parts)...);
  std::fwrite(text.data(), 1, text.size(), stderr);
}

/// Takes the places of those standard streams that are closed, so that no file of a run gets one of
/// them and messages are written into it. Using them fails as before.
void occupy_closed_streams() noexcept;

/// Standard output is a pipe whose other end is closed.
bool nobody_reads_the_output() noexcept;

/// Columns of the terminal behind standard error; 80 if it does not tell.
std::size_t terminal_width();

}  // namespace riesel::app
