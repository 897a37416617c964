#include "io/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace riesel::io {
namespace {

constexpr double left = 70.0, top = 10.0;  // of the frame
constexpr double right_margin = 14.0, bottom_margin = 42.0;
constexpr std::string_view ink = "#333333", faint = "#dddddd";

Interval clipped(Interval range, Interval limits) {
  return {std::clamp(range.low, limits.low, limits.high),
          std::clamp(range.high, limits.low, limits.high)};
}

bool contains(Interval range, double value) { return value >= range.low && value <= range.high; }

}  // namespace

Interval range_of(std::span<const double> values) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (low > high) return {0.0, 1.0};
  const double spread = high - low;
  const double room = spread > 0.0 ? 0.05 * spread : low == 0.0 ? 1.0 : 0.1 * std::abs(low);
  return {low - room, high + room};
}

std::vector<double> ticks(Interval range, int most) {
  const double coarsest = range.high - range.low;
  const double unit = std::pow(10.0, std::floor(std::log10(coarsest / most)));
  std::vector<double> found;
  for (const double factor : {1.0, 2.0, 5.0, 10.0}) {
    const double step = factor * unit;
    const double first = std::ceil(range.low / step), last = std::floor(range.high / step);
    found.clear();
    if (last - first >= most) continue;
    for (double k = first; k <= last; k += 1.0) found.push_back(k * step + 0.0);  // no -0
    break;
  }
  return found;
}

std::vector<Point> thinned(std::span<const Point> points, std::size_t columns) {
  if (points.size() <= 4 * columns) return {points.begin(), points.end()};
  const double begin = points.front().x;
  const double width = (points.back().x - begin) / static_cast<double>(columns);
  const auto column_of = [&](std::size_t i) { return std::floor((points[i].x - begin) / width); };
  const auto lower = [&](std::size_t a, std::size_t b) { return points[a].y < points[b].y; };

  std::vector<Point> kept;
  for (std::size_t first = 0; first < points.size();) {
    std::size_t last = first, lowest = first, highest = first;
    while (last + 1 < points.size() && column_of(last + 1) == column_of(first)) {
      ++last;
      if (lower(last, lowest)) lowest = last;
      if (lower(highest, last)) highest = last;
    }
    std::vector<std::size_t> of_column = {first, lowest, highest, last};
    std::sort(of_column.begin(), of_column.end());
    of_column.erase(std::unique(of_column.begin(), of_column.end()), of_column.end());
    for (const std::size_t i : of_column) kept.push_back(points[i]);
    first = last + 1;
  }
  return kept;
}

Plot::Plot(double width, double height, std::string_view description, Axis x, Axis y)
    : x_(std::move(x)),
      y_(std::move(y)),
      right_(width - right_margin),
      bottom_(height - bottom_margin),
      svg_(width, height, description) {
  draw_axes();
}

Point Plot::at(double x, double y) const {
  const double across = (x - x_.range.low) / (x_.range.high - x_.range.low);
  const double up = (y - y_.range.low) / (y_.range.high - y_.range.low);
  return {left + across * (right_ - left), bottom_ - up * (bottom_ - top)};
}

void Plot::draw_axes() {
  svg_.begin_group("axes", {.fill = ink});
  for (const double value : ticks(x_.range, 9)) {
    const double x = at(value, y_.range.low).x;
    svg_.line({x, top}, {x, bottom_}, {.stroke = faint});
    svg_.text({x, bottom_ + 16.0}, fmt::format("{:.6g}", value), {.anchor = "middle"});
  }
  for (const double value : ticks(y_.range, 6)) {
    const double y = at(x_.range.low, value).y;
    svg_.line({left, y}, {right_, y}, {.stroke = faint});
    svg_.text({left - 6.0, y + 4.0}, fmt::format("{:.6g}", value), {.anchor = "end"});
  }
  svg_.rectangle({left, top}, right_ - left, bottom_ - top, {.fill = "none", .stroke = ink});
  svg_.text({0.5 * (left + right_), bottom_ + 34.0}, x_.label, {.anchor = "middle"});
  svg_.upward_text({14.0, 0.5 * (top + bottom_)}, y_.label, {.anchor = "middle"});
  svg_.end_group();
}

void Plot::curve(std::span<const double> x, std::span<const double> y, const Style& style) {
  const auto columns = static_cast<std::size_t>(right_ - left);
  std::vector<Point> piece;
  const auto draw = [&] {
    if (!piece.empty()) svg_.polyline(thinned(piece, columns), style);
    piece.clear();
  };
  svg_.begin_group("curve", {.fill = "none"});
  for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i) {
    if (std::isfinite(x[i]) && std::isfinite(y[i]))
      piece.push_back(at(x[i], y[i]));
    else
      draw();
  }
  draw();
  svg_.end_group();
}

void Plot::area(Interval x, Interval y, const Style& style) {
  const Interval across = clipped(x, x_.range), up = clipped(y, y_.range);
  const Point corner = at(across.low, up.high), opposite = at(across.high, up.low);
  svg_.rectangle(corner, opposite.x - corner.x, opposite.y - corner.y, style);
}

void Plot::level(Interval x, double y, const Style& style) {
  if (!contains(y_.range, y)) return;
  const Interval across = clipped(x, x_.range);
  svg_.line(at(across.low, y), at(across.high, y), style);
}

void Plot::moment(double x, std::string_view label, const Style& style) {
  if (!contains(x_.range, x)) return;
  svg_.line(at(x, y_.range.low), at(x, y_.range.high), style);
  const bool to_the_left = x > 0.5 * (x_.range.low + x_.range.high);
  const Point place = at(x, y_.range.high);
  svg_.text({place.x + (to_the_left ? -5.0 : 5.0), place.y + 14.0}, label,
            {.fill = style.stroke, .anchor = to_the_left ? "end" : "start"});
}

}  // namespace riesel::io
