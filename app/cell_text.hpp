// A value of a sweep's settings, as a text.
#pragma once

#include "io/sweep_manifest.hpp"

#include <string>

namespace riesel::app {

/// With its unit; in as many digits as tell it from others; empty for nothing.
std::string text_of(const io::Cell& cell, const std::string& unit = "");

}  // namespace riesel::app
