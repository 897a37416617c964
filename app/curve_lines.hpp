// The curve of impacts for each v_x, and the few numbers that characterise it in tables of sweeps.
#pragma once

#include "io/summary.hpp"

#include <span>
#include <vector>

namespace riesel::app {

/// The points of each v_x, by increasing v_y; the v_x in the order of their first points.
std::vector<std::vector<io::CurvePoint>> points_by_v_x(std::span<const io::CurvePoint> curve);

/// One for each v_x, in increasing order. Numbers that the curve does not show are NaN.
std::vector<io::CurveLine> lines_of(std::span<const io::CurvePoint> curve);

}  // namespace riesel::app
