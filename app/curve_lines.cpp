#include "app/curve_lines.hpp"

#include "engine/estimate.hpp"

#include <algorithm>
#include <cmath>

namespace riesel::app {

namespace {

using Points = std::vector<io::CurvePoint>;

/// Where the value rises through the level for the last time and stays above, interpolated
/// linearly: as means of few starts scatter, it may touch the level before. Unknown if it is above
/// from the beginning.
io::Rise where_it_rises(const Points& points, double io::CurvePoint::*value, double level) {
  const io::CurvePoint* below = nullptr;
  io::Rise rise;
  for (const io::CurvePoint& point : points) {
    if (std::isnan(point.*value)) continue;
    if (point.*value < level) {
      below = &point;
      rise = {};
    } else if (below != nullptr && std::isnan(rise.at)) {
      const double part = (level - below->*value) / (point.*value - below->*value);
      rise.within = point.v_y - below->v_y;
      rise.at = below->v_y + part * rise.within;
    }
  }
  return rise;
}

/// `points`: of one v_x, by increasing v_y.
io::CurveLine line_of(const Points& points) {
  io::CurveLine line{.v_x = points.front().v_x};
  line.brake_fails =
      where_it_rises(points, &io::CurvePoint::brake_failure_fraction, unphysical_brake_failure);
  line.two_contacts = where_it_rises(points, &io::CurvePoint::contacts, 2.0);
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

std::vector<Points> points_by_v_x(std::span<const io::CurvePoint> curve) {
  std::vector<Points> all;
  for (const io::CurvePoint& point : curve) {
    const auto found = std::ranges::find_if(
        all, [&](const Points& points) { return points.front().v_x == point.v_x; });
    if (found == all.end())
      all.push_back({point});
    else
      found->push_back(point);
  }
  for (Points& points : all) std::ranges::stable_sort(points, {}, &io::CurvePoint::v_y);
  return all;
}

std::vector<io::CurveLine> lines_of(std::span<const io::CurvePoint> curve) {
  std::vector<io::CurveLine> lines;
  for (const Points& points : points_by_v_x(curve)) lines.push_back(line_of(points));
  std::ranges::sort(lines, {}, &io::CurveLine::v_x);
  return lines;
}

}  // namespace riesel::app
