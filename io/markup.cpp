#include "io/markup.hpp"

namespace riesel::io {

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
      result += "\xEF\xBF\xBD";
    else
      result += c;
  }
  return result;
}

}  // namespace riesel::io
