// Verdicts in plain words, for the screen and for the report.
#pragma once

#include "engine/validity.hpp"

#include <string>

namespace riesel::app {

/// What it means that a flow is "steady", "accelerating", "drifting" or "too_short".
std::string explanation(const std::string& state);

/// What speaks against a run: the value, the threshold it passed, what it means and what helps.
std::string explanation(const Finding& finding);

}  // namespace riesel::app
