#include "io/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
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

}  // namespace

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

Look look_of(std::size_t index) {
  constexpr std::array<std::string_view, different_looks> colours = {
      "#26548c", "#d9730d", "#2e7d32", "#a3245b", "#6b4fa0", "#8a6d1d", "#0f8a8a", "#555555"};
  constexpr std::array symbols = {Symbol::disc, Symbol::square, Symbol::triangle, Symbol::diamond};
  return {.colour = colours.at(index % colours.size()),
          .symbol = symbols.at(index % symbols.size())};
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
  return {left + part_of(x_, x) * (right_ - left), bottom_ - part_of(y_, y) * (bottom_ - top)};
}

void Plot::draw_axes() {
  svg_.begin_group("axes", {.fill = ink});
  for (const double value : ticks_of(x_, 9)) {
    const double x = at(value, y_.range.low).x;
    svg_.line({x, top}, {x, bottom_}, {.stroke = faint});
    svg_.text({x, bottom_ + 16.0}, fmt::format("{:.6g}", value), {.anchor = "middle"});
  }
  for (const double value : ticks_of(y_, 6)) {
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
    if (piece.size() == 1)  // a line of no length paints nothing
      draw_single(piece.front(), style);
    else if (!piece.empty())
      svg_.polyline(thinned(piece, columns), style);
    piece.clear();
  };
  svg_.begin_group("curve", {.fill = "none"});
  for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i) {
    const Point place = at(x[i], y[i]);
    if (std::isfinite(place.x) && std::isfinite(place.y))
      piece.push_back(place);
    else
      draw();
  }
  draw();
  svg_.end_group();
}

void Plot::draw_single(Point place, const Style& style) {
  svg_.disc(place, 2.5,
            {.fill = style.dashes.empty() ? style.stroke : "#ffffff",
             .stroke = style.stroke,
             .stroke_width = style.stroke_width});
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

void Plot::marker(double x, std::string_view label, const Style& style, int row) {
  constexpr double width_of_letter = 6.5;
  if (!contains(x_.range, x)) return;
  const Point top_end = at(x, y_.range.high);
  const double begin = top_end.y + 14.0 * row;
  svg_.line(at(x, y_.range.low), {top_end.x, begin}, style);
  // On the right of a lower row are the lines of larger x.
  const bool fits = top_end.x - left > 5.0 + width_of_letter * static_cast<double>(label.size());
  const bool to_the_left = part_of(x_, x) > 0.5 || (row > 0 && fits);
  svg_.text({top_end.x + (to_the_left ? -5.0 : 5.0), begin + 14.0}, label,
            {.fill = style.stroke, .anchor = to_the_left ? "end" : "start"});
}

void Plot::draw_symbol(Point place, const Look& look, bool is_full) {
  const Style style{
      .fill = is_full ? look.colour : "#ffffff", .stroke = look.colour, .stroke_width = 1.5};
  const auto [x, y] = place;
  switch (look.symbol) {
  case Symbol::disc:
    return svg_.disc(place, 4.5, style);
  case Symbol::square:
    return svg_.rectangle({x - 4.0, y - 4.0}, 8.0, 8.0, style);
  case Symbol::triangle:
    return svg_.polygon(
        std::array<Point, 3>{{{x, y - 5.5}, {x + 5.0, y + 3.5}, {x - 5.0, y + 3.5}}}, style);
  case Symbol::diamond:
    return svg_.polygon(
        std::array<Point, 4>{{{x, y - 5.5}, {x + 5.5, y}, {x, y + 5.5}, {x - 5.5, y}}}, style);
  }
}

void Plot::error_bar(double x, double y, double error, std::string_view colour) {
  if (!std::isfinite(at(x, y).x) || !std::isfinite(at(x, y).y) || !std::isfinite(error)) return;
  const Style thin{.stroke = colour, .stroke_width = 1.2};
  const Interval bar = clipped({y - error, y + error}, y_.range);
  const Point low = at(x, bar.low), high = at(x, bar.high);
  svg_.line(low, high, thin);
  for (const Point& end : {low, high}) svg_.line({end.x - 3.0, end.y}, {end.x + 3.0, end.y}, thin);
}

void Plot::measured(double x, double y, double error, const Look& look, bool is_full) {
  const Point place = at(x, y);
  if (!std::isfinite(place.x) || !std::isfinite(place.y)) return;
  error_bar(x, y, error, look.colour);
  draw_symbol(place, look, is_full);
}

void Plot::arrow_up(double x, double y, const Look& look) {
  const Point place = at(x, y);
  if (!std::isfinite(place.x) || !std::isfinite(place.y)) return;
  const double foot = place.y - 7.0, tip = place.y - 22.0;
  svg_.line({place.x, foot}, {place.x, tip}, {.stroke = look.colour, .stroke_width = 1.5});
  svg_.polygon(
      std::array<Point, 3>{
          {{place.x, tip - 5.0}, {place.x + 3.5, tip + 2.0}, {place.x - 3.5, tip + 2.0}}},
      {.fill = look.colour});
}

void Plot::cross(double x, double y, const Look& look) {
  constexpr double reach = 6.5;
  const Point c = at(x, y);
  if (!std::isfinite(c.x) || !std::isfinite(c.y)) return;
  const Style style{.stroke = look.colour, .stroke_width = 1.2};
  svg_.line({c.x - reach, c.y - reach}, {c.x + reach, c.y + reach}, style);
  svg_.line({c.x - reach, c.y + reach}, {c.x + reach, c.y - reach}, style);
}

void Plot::legend(std::string_view shared, const std::vector<std::pair<std::string, Look>>& entries,
                  bool with_symbols) {
  constexpr double row = 18.0, sample = 28.0;
  const double begin = bottom_ + bottom_margin + 0.5 * row;
  double y = begin;
  svg_.begin_group("legend");
  if (!shared.empty()) {
    svg_.text({left, y + 4.0}, shared, {.font_size = "13"});
    y += row;
  }
  for (const auto& [name, look] : entries) {
    svg_.line({left, y}, {left + sample, y}, {.stroke = look.colour, .stroke_width = 1.5});
    if (with_symbols) draw_symbol({left + 0.5 * sample, y}, look, true);
    svg_.text({left + sample + 8.0, y + 4.0}, name);
    y += row;
  }
  svg_.end_group();
  svg_.extend(y - begin + 4.0);
}

}  // namespace riesel::io
