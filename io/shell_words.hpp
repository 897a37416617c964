// Words as a shell takes them: for command lines that are kept, shown to be copied, or called.
#pragma once

#include <string>

namespace riesel::io {

/// In single quotes, whatever the word contains. A plain one stays as it is.
std::string in_quotes(const std::string& word);

}  // namespace riesel::io
