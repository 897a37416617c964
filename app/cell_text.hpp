// A value of a sweep's settings, as text.
#pragma once

#include "io/sweep_manifest.hpp"

#include <string>

namespace riesel::app {

/// The value followed by its unit, with as many digits as tell it from any other; "" for no value.
std::string text_of(const io::Cell& cell, const std::string& unit = "");

}  // namespace riesel::app
