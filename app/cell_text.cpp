#include "app/cell_text.hpp"

#include "io/units.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <variant>

namespace riesel::app {

namespace {

/// Six digits, which hide rounding errors, if that is the number; otherwise as many as it takes.
std::string text_of(double number) {
  constexpr double rounding = 1e-12;
  if (!std::isfinite(number)) return fmt::format("{}", number);
  std::string text = fmt::format("{:.6g}", number);
  const double told = io::decimal_value(text).value_or(0.0);
  return std::abs(told - number) <= rounding * std::abs(number) ? text : fmt::format("{}", number);
}

}  // namespace

std::string text_of(const io::Cell& cell, const std::string& unit) {
  if (const auto* number = std::get_if<double>(&cell))
    return text_of(*number) + (unit.empty() || unit == "1" ? "" : " " + unit);
  const auto* text = std::get_if<std::string>(&cell);
  return text != nullptr ? *text : "";
}

}  // namespace riesel::app
