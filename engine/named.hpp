// Enumerations as words in files.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace riesel {

/// The word of each value of an enumeration.
template <class Value>
struct Word {
  Value value;
  std::string_view text;
};

/// The word of a value; all of them must be in the table.
template <class Value, std::size_t n>
constexpr std::string_view name_in(const std::array<Word<Value>, n>& words, Value value) {
  for (const Word<Value>& word : words)
    if (word.value == value) return word.text;
  return "unknown";
}

/// The value whose word is this text; nothing if there is none.
template <class Value, std::size_t n>
constexpr std::optional<Value> value_in(const std::array<Word<Value>, n>& words,
                                        std::string_view text) {
  for (const Word<Value>& word : words)
    if (word.text == text) return word.value;
  return std::nullopt;
}

}  // namespace riesel
