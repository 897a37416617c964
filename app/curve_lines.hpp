// What the curve of impacts with one v_x comes to in a few numbers, for tables of sweeps.
#pragma once

#include "io/summary.hpp"

#include <span>
#include <vector>

namespace riesel::app {

/// One for each v_x, in increasing order. What the curve does not show is not a number.
std::vector<io::CurveLine> lines_of(std::span<const io::CurvePoint> curve);

}  // namespace riesel::app
