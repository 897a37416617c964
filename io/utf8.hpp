// What UTF-8 is made of, as far as it is looked at here. Internal.
#pragma once

#include <string_view>

namespace riesel::io {

/// A byte that is not the first of its character.
inline bool continues_character(char byte) {
  return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U;
}

/// Editors of other systems put one at the beginning of a file.
inline std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  return text.starts_with(mark) ? text.substr(mark.size()) : text;
}

}  // namespace riesel::io
