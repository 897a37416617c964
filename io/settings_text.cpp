#include "io/settings_text.hpp"

#include "io/utf8.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <system_error>
#include <utility>

namespace riesel::io {
namespace {

[[noreturn]] void refuse_size(const std::string& source) {
  throw SettingsError({source}, "", fmt::format("is larger than {} bytes", largest_settings_text),
                      "a settings file is a page of YAML; check that this is the right file");
}

void refuse_bad_characters(const std::string& text, const std::string& source) {
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = character_length(text, i);
    if (length == 0) {
      throw SettingsError(PlaceFinder(text, source).at(i), "", "is not UTF-8",
                          "save the file as UTF-8");
    }
    const auto byte = static_cast<unsigned char>(text[i]);
    if ((byte < 0x20U && byte != '\n' && byte != '\t') || byte == 0x7FU) {
      throw SettingsError(PlaceFinder(text, source).at(i), "",
                          fmt::format("control character 0x{:02X}", byte),
                          "remove it, or check that this is a text file");
    }
    i += length;
  }
}

void refuse_tab_indentation(const std::string& text, const std::string& source) {
  bool in_indentation = true;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (in_indentation && text[i] == '\t') {
      throw SettingsError(PlaceFinder(text, source).at(i), "", "tab in the indentation",
                          "YAML is indented with spaces: replace it");
    }
    in_indentation = text[i] == '\n' || (in_indentation && text[i] == ' ');
  }
}

}  // namespace

std::string read_settings_text(const std::filesystem::path& file) {
  const std::string source = file.string();
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) {
    throw SettingsError({source}, "", "is a directory", "give the path of a YAML file");
  }
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    const auto reason = std::generic_category().message(errno);
    throw SettingsError({source}, "", fmt::format("cannot be opened ({})", reason),
                        "check the path");
  }
  // The file system does not know the size of a pipe, so one byte more than allowed is read.
  std::string text(largest_settings_text + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (stream.bad()) throw SettingsError({source}, "", "cannot be read", "check the file");
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (text.size() > largest_settings_text) refuse_size(source);
  return text;
}

std::string read_kept_text(const std::filesystem::path& file) {
  std::error_code ignored;
  const auto status = std::filesystem::status(file, ignored);
  const bool is_other = std::filesystem::exists(status) && !is_directory(status);
  if (is_other && !is_regular_file(status))
    throw SettingsError({file.string()}, "", "is no regular file", "remove it");
  return read_settings_text(file);
}

std::string with_plain_line_ends(std::string_view text) {
  std::string plain;
  plain.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool before_newline = text[i] == '\r' && i + 1 < text.size() && text[i + 1] == '\n';
    if (!before_newline) plain += text[i];
  }
  return plain;
}

std::string clean_settings_text(std::string_view text, const std::string& source) {
  if (text.size() > largest_settings_text) refuse_size(source);
  std::string clean = with_plain_line_ends(without_byte_order_mark(text));
  refuse_bad_characters(clean, source);
  refuse_tab_indentation(clean, source);
  return clean;
}

PlaceFinder::PlaceFinder(std::string_view text, std::string source)
    : text_(text), place_{std::move(source), 1, 1} {}

Place PlaceFinder::at(std::size_t offset) {
  if (offset < offset_) *this = PlaceFinder(text_, place_.source);
  for (; offset_ < std::min(offset, text_.size()); ++offset_) {
    if (text_[offset_] == '\n') {
      ++place_.line;
      place_.column = 1;
    } else if (!continues_character(text_[offset_])) {
      ++place_.column;
    }
  }
  return place_;
}

}  // namespace riesel::io
