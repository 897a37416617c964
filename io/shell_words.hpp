// Words quoted for a shell: for command lines that are stored, shown for copying, or executed.
#pragma once

#include <string>

namespace riesel::io {

/// In single quotes, whatever the word contains. A plain one stays as it is.
std::string in_quotes(const std::string& word);

}  // namespace riesel::io
