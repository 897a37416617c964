#include "io/markup.hpp"

namespace riesel::io {

namespace {

constexpr std::string_view replacement_character = "\xEF\xBF\xBD";

void replace_all(std::string& text, std::string_view old) {
  for (auto at = text.find(old); at != std::string::npos; at = text.find(old, at))
    text.replace(at, old.size(), replacement_character);
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    const bool is_control =
        (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t') || c == 0x7f;
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else if (c == '\'')
      result += "&#39;";
    else if (is_control)
      result += replacement_character;
    else
      result += c;
  }
  for (const std::string_view forbidden : {"\xEF\xBF\xBE", "\xEF\xBF\xBF"})
    replace_all(result, forbidden);
  return result;
}

}  // namespace riesel::io
