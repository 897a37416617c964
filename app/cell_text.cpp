#include "app/cell_text.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <variant>

namespace riesel::app {

namespace {

/// Six digits, which hide rounding errors, if that is the number; otherwise as many as it takes.
std::string text_of(double number) {
  constexpr double rounding = 1e-12;
  std::string text = fmt::format("{:.6g}", number);
  const bool tells = std::abs(std::stod(text) - number) <= rounding * std::abs(number);
  return tells || !std::isfinite(number) ? text : fmt::format("{}", number);
}

}  // namespace

std::string text_of(const io::Cell& cell, const std::string& unit) {
  if (const auto* number = std::get_if<double>(&cell))
    return text_of(*number) + (unit.empty() || unit == "1" ? "" : " " + unit);
  const auto* text = std::get_if<std::string>(&cell);
  return text != nullptr ? *text : "";
}

}  // namespace riesel::app
