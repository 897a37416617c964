// Enumerations as words in files.
#pragma once

#include <initializer_list>
#include <optional>
#include <string_view>

namespace riesel {

/// The one of `all` whose name() is the text; nothing if there is none.
template <class Word>
std::optional<Word> named(std::string_view text, std::initializer_list<Word> all) {
  for (const Word word : all)
    if (name(word) == text) return word;
  return std::nullopt;
}

}  // namespace riesel
