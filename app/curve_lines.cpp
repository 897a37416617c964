#include "app/curve_lines.hpp"

#include "engine/estimate.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace riesel::app {

namespace {

using Points = std::vector<io::CurvePoint>;

/// v_y at which the value rises through the level, not to come below it again, on the straight line
/// between the points on both sides: the means of few starts scatter, and may touch it before.
double where_it_rises(const Points& points, double io::CurvePoint::*value, double level) {
  const io::CurvePoint* below = nullptr;
  double rise = unknown;  // also if it is above from the beginning
  for (const io::CurvePoint& point : points) {
    if (std::isnan(point.*value)) continue;
    if (point.*value < level) {
      below = &point;
      rise = unknown;
    } else if (below != nullptr && std::isnan(rise)) {
      const double part = (level - below->*value) / (point.*value - below->*value);
      rise = below->v_y + part * (point.v_y - below->v_y);
    }
  }
  return rise;
}

io::CurveLine line_of(double v_x, Points points) {
  std::ranges::sort(points, {}, &io::CurvePoint::v_y);
  io::CurveLine line{.v_x = v_x};
  line.brake_fails_at =
      where_it_rises(points, &io::CurvePoint::brake_failure_fraction, unphysical_brake_failure);
  line.two_contacts_at = where_it_rises(points, &io::CurvePoint::contacts, 2.0);
  for (const io::CurvePoint& point : points) {
    const bool brakes = !(point.brake_failure_fraction >= unphysical_brake_failure);
    if (brakes && !(point.dv_y <= line.largest_dv_y) && !std::isnan(point.dv_y)) {
      line.largest_dv_y = point.dv_y;
      line.largest_at = point.v_y;
    }
  }
  return line;
}

}  // namespace

std::vector<io::CurveLine> lines_of(std::span<const io::CurvePoint> curve) {
  std::map<double, Points> points;
  for (const io::CurvePoint& point : curve) points[point.v_x].push_back(point);
  std::vector<io::CurveLine> lines;
  for (const auto& [v_x, of_this] : points) lines.push_back(line_of(v_x, of_this));
  return lines;
}

}  // namespace riesel::app
