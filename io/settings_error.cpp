#include "io/settings_error.hpp"

#include "io/utf8.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

namespace riesel::io {
namespace {

constexpr std::size_t longest_excerpt = 60;

/// Keys and values may contain line breaks; a message is one line.
std::string on_one_line(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20U) c = ' ';
  }
  return text;
}

std::string excerpt(const std::string& text) {
  if (text.size() <= longest_excerpt) return text;
  std::size_t end = longest_excerpt;
  while (end > 0 && continues_character(text[end])) --end;
  return text.substr(0, end) + "...";
}

std::string message(const Place& place, const std::string& key, const std::string& problem,
                    const std::string& remedy) {
  const auto subject = key.empty() ? "" : excerpt(key) + ": ";
  return on_one_line(fmt::format("{}: {}{}; {}", to_string(place), subject, problem, remedy));
}

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

SettingsError::SettingsError(const SettingsError& first, const std::string& what_of_all)
    : std::runtime_error(what_of_all),
      place_(first.place_),
      key_(first.key_),
      problem_(first.problem_),
      remedy_(first.remedy_) {}

void Mistakes::throw_if_any() {
  if (!any()) return;
  // Overrides, which have no lines, come last.
  const auto order = [](const SettingsError& error) {
    const auto& [source, line, column] = error.place();
    return std::tuple(line == 0 ? std::numeric_limits<int>::max() : line, column);
  };
  std::ranges::stable_sort(all_, {}, order);
  std::string lines = all_.front().what();
  for (std::size_t i = 1; i < all_.size(); ++i) lines += std::string("\n") + all_[i].what();
  if (all_.size() == most_reported)
    lines += fmt::format("\n... and perhaps more: these are the first {}", most_reported);
  throw SettingsError(all_.front(), lines);
}

std::string quoted(const std::string& text) {
  return fmt::format("'{}'", on_one_line(excerpt(text)));
}

}  // namespace riesel::io
