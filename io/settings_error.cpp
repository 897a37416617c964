#include "io/settings_error.hpp"

#include <fmt/format.h>

#include <utility>

namespace riesel::io {
namespace {

constexpr std::size_t longest_quote = 60;

std::string message(const Place& place, const std::string& key, const std::string& problem,
                    const std::string& remedy) {
  return fmt::format("{}: {}{}{}; {}", to_string(place), key, key.empty() ? "" : ": ", problem,
                     remedy);
}

bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

}  // namespace

std::string to_string(const Place& place) {
  if (place.line == 0) return place.source;
  return fmt::format("{}:{}:{}", place.source, place.line, place.column);
}

SettingsError::SettingsError(Place place, std::string key, std::string problem, std::string remedy)
    : std::runtime_error(message(place, key, problem, remedy)),
      place_(std::move(place)),
      key_(std::move(key)),
      problem_(std::move(problem)),
      remedy_(std::move(remedy)) {}

std::string quoted(const std::string& text) {
  std::string line;
  for (const char c : text) {
    if (line.size() >= longest_quote && !continues_character(c))
      return fmt::format("'{}...'", line);
    line += static_cast<unsigned char>(c) < 0x20U ? ' ' : c;
  }
  return fmt::format("'{}'", line);
}

}  // namespace riesel::io
