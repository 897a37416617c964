// The parts of UTF-8 that are needed here. Internal.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

namespace riesel::io {

/// A byte that is not the first of its character.
inline bool continues_character(char byte) {
  return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U;
}

/// The length in bytes of the character that begins at text[i]; 0 if none does (RFC 3629, section
/// 4).
inline std::size_t character_length(std::string_view text, std::size_t i) {
  const auto byte_at = [&](std::size_t k) -> unsigned {
    return static_cast<unsigned char>(text[k]);
  };
  const unsigned lead = byte_at(i);
  if (lead < 0x80U) return 1;
  if (lead < 0xC2U || lead > 0xF4U) return 0;
  const std::size_t length = lead < 0xE0U ? 2 : lead < 0xF0U ? 3 : 4;
  if (text.size() - i < length) return 0;

  // After these leads the second byte has a narrower range: no overlong forms, no surrogates,
  // nothing beyond U+10FFFF.
  const unsigned second = byte_at(i + 1);
  const unsigned lowest = lead == 0xE0U ? 0xA0U : lead == 0xF0U ? 0x90U : 0x80U;
  const unsigned highest = lead == 0xEDU ? 0x9FU : lead == 0xF4U ? 0x8FU : 0xBFU;
  if (second < lowest || second > highest) return 0;
  const auto rest = text.substr(i + 2, length - 2);
  return std::ranges::all_of(rest, continues_character) ? length : 0;
}

inline bool is_utf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = character_length(text, i);
    if (length == 0) return false;
    i += length;
  }
  return true;
}

/// With a question mark in place of each byte that is not valid UTF-8.
inline std::string made_utf8(std::string_view text) {
  std::string made;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = character_length(text, i);
    made += length == 0 ? "?" : text.substr(i, length);
    i += std::max<std::size_t>(length, 1);
  }
  return made;
}

/// Some editors put one at the beginning of a file.
inline std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  return text.starts_with(mark) ? text.substr(mark.size()) : text;
}

}  // namespace riesel::io
