#include "io/colour_scale.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace riesel::io {
namespace {

using Colour = std::array<double, 3>;  // red, green, blue, 0 ... 255

constexpr std::array<Colour, 5> stops = {
    {{36, 28, 92}, {38, 84, 140}, {34, 140, 140}, {112, 194, 104}, {250, 232, 96}}};

}  // namespace

std::string colour(double fraction) {
  if (std::isnan(fraction)) return "#999999";
  const double place = std::clamp(fraction, 0.0, 1.0) * (stops.size() - 1);
  const auto first = std::min(static_cast<std::size_t>(place), stops.size() - 2);
  const double part = place - static_cast<double>(first);
  const auto mixed = [&](std::size_t i) {
    return std::lround((1.0 - part) * stops.at(first).at(i) + part * stops.at(first + 1).at(i));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", mixed(0), mixed(1), mixed(2));
}

}  // namespace riesel::io
