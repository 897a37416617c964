#include "app/option_values.hpp"

#include <fmt/format.h>

#include <charconv>
#include <string>
#include <system_error>

namespace riesel::app {

CLI::Validator whole_number(std::size_t low, std::size_t high) {
  const auto read = [=](std::string& text) -> std::string {
    std::size_t number = 0;
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, number);
    if (error != std::errc() || rest != end || number < low || number > high)
      return fmt::format("Value {} not in range {} to {} (decimal digits)", text, low, high);
    text = std::to_string(number);
    return "";
  };
  return {read, fmt::format("INT in [{} - {}]", low, high)};
}

CLI::Validator some_name() {
  const auto read = [](std::string& text) { return std::string(text.empty() ? "is empty" : ""); };
  return {read, ""};
}

}  // namespace riesel::app
