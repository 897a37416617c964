// The curve of impacts with each v_x, and what it comes to in a few numbers, for tables of sweeps.
#pragma once

#include "io/summary.hpp"

#include <span>
#include <vector>

namespace riesel::app {

/// The points of each v_x by increasing v_y; the v_x in the order in which they come first.
std::vector<std::vector<io::CurvePoint>> points_by_v_x(std::span<const io::CurvePoint> curve);

/// One for each v_x, in increasing order. What the curve does not show is not a number.
std::vector<io::CurveLine> lines_of(std::span<const io::CurvePoint> curve);

}  // namespace riesel::app
