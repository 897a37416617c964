// Words quoted for a shell: for command lines that are stored, shown for copying, or executed.
#pragma once

#include <filesystem>
#include <string>

namespace riesel::io {

/// In single quotes, whatever the word contains. A plain one stays as it is.
std::string in_quotes(const std::string& word);

/// The path as an argument of a command, in quotes where need be: one that begins with '-' would be
/// taken for an option, and has ./ in front.
std::string path_argument(const std::filesystem::path& path);

}  // namespace riesel::io
