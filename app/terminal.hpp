// Messages to the user, and what is special at a terminal: colours, and lines that fit its width.
// If NO_COLOR is set in the environment (no-color.org), there are no colours.
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

/// Writes to standard error. Failure is ignored: a run goes on even if the reader of its messages
/// has gone, or the disk of its log is full.
template <class... Parts>
void tell(fmt::format_string<Parts...> format, Parts&&... parts) {
  const std::string text = fmt::format(format, std::forward<Parts>(parts)...);
  std::fwrite(text.data(), 1, text.size(), stderr);
}

/// Occupies the descriptors of standard streams that are closed. Otherwise a file of the run could
/// get such a descriptor, and messages would be written into it. Using the streams still fails.
void occupy_closed_streams() noexcept;

/// Whether standard output is a pipe whose other end is closed.
bool nobody_reads_the_output() noexcept;

/// Columns of the terminal at standard error; 80 if they are not known.
std::size_t terminal_width();

}  // namespace riesel::app
