#include "io/shell_words.hpp"

namespace riesel::io {

std::string in_quotes(const std::string& word) {
  constexpr auto plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./:,@%";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string path_argument(const std::filesystem::path& path) {
  const std::string word = path.string();
  return in_quotes(word.starts_with('-') ? "./" + word : word);
}

}  // namespace riesel::io
