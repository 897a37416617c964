// The bytes of a settings file before YAML: what must be true of them whatever they say.
#pragma once

#include "io/settings_error.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace riesel::io {

constexpr std::size_t largest_settings_text = 1'000'000;  ///< bytes

/// The file verbatim, which may be a pipe. Throws SettingsError if it cannot be read, is a
/// directory or is too large.
std::string read_settings_text(const std::filesystem::path& file);

/// A file that riesel keeps in the directory of a run or a sweep: refused, too, if it is no regular
/// file, as a pipe that nobody writes to would be waited for.
std::string read_kept_text(const std::filesystem::path& file);

/// With each carriage return and line feed replaced by a line feed alone.
std::string with_plain_line_ends(std::string_view text);

/// The text as the YAML parser is to see it: without byte order mark, lines ending in \n. Throws
/// SettingsError if it is too large, is not UTF-8, contains control characters, or is indented with
/// tabs.
std::string clean_settings_text(std::string_view text, const std::string& source);

/// The line and column of each byte in a text, columns counted in characters as editors do. Asking
/// for places in ascending order takes time proportional to the text in all.
class PlaceFinder {
public:
  /// `text` must outlive the finder.
  PlaceFinder(std::string_view text, std::string source);

  Place at(std::size_t offset);

private:
  std::string_view text_;
  Place place_;  ///< of offset_
  std::size_t offset_ = 0;
};

}  // namespace riesel::io
