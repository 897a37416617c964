#include "io/svg.hpp"

#include "io/build_info.hpp"
#include "io/markup.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace riesel::io {
namespace {

/// Two decimals at most.
std::string number(double value) {
  if (!std::isfinite(value)) throw std::invalid_argument("a coordinate that is not finite");
  auto text = fmt::format("{:.2f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string attribute(std::string_view name, std::string_view value) {
  return value.empty() ? "" : fmt::format(" {}=\"{}\"", name, escaped(value));
}

std::string attribute(std::string_view name, double value) {
  return attribute(name, number(value));
}

std::string list_of(std::span<const Point> points) {
  std::string list;
  for (const Point& point : points)
    list += (list.empty() ? "" : " ") + number(point.x) + "," + number(point.y);
  return list;
}

std::string attributes(const Style& style) {
  return attribute("fill", style.fill) + attribute("stroke", style.stroke)
         + (style.stroke_width > 0.0 ? attribute("stroke-width", style.stroke_width) : "")
         + attribute("stroke-dasharray", style.dashes) + attribute("text-anchor", style.anchor)
         + attribute("font-size", style.font_size);
}

}  // namespace

Svg::Svg(double width, double height, std::string_view description)
    : width_(width), height_(height), description_(description) {}

void Svg::begin_group(std::string_view name, const Style& style) {
  shapes_ += "<g" + attribute("class", name) + attributes(style) + ">\n";
}

void Svg::end_group() { shapes_ += "</g>\n"; }

void Svg::begin_link(std::string_view address, std::string_view tip) {
  has_links_ = true;
  shapes_ += "<a" + attribute("href", address) + "><title>" + escaped(tip) + "</title>\n";
}

void Svg::end_link() { shapes_ += "</a>\n"; }

void Svg::disc(Point centre, double radius, const Style& style) {
  shapes_ += "<circle" + attribute("cx", centre.x) + attribute("cy", centre.y)
             + attribute("r", radius) + attributes(style) + "/>\n";
}

void Svg::line(Point from, Point to, const Style& style) {
  shapes_ += "<line" + attribute("x1", from.x) + attribute("y1", from.y) + attribute("x2", to.x)
             + attribute("y2", to.y) + attributes(style) + "/>\n";
}

void Svg::polyline(std::span<const Point> points, const Style& style) {
  shapes_ += "<polyline" + attribute("points", list_of(points)) + attributes(style) + "/>\n";
}

void Svg::polygon(std::span<const Point> points, const Style& style) {
  shapes_ += "<polygon" + attribute("points", list_of(points)) + attributes(style) + "/>\n";
}

void Svg::rectangle(Point corner, double width, double height, const Style& style) {
  shapes_ += "<rect" + attribute("x", corner.x) + attribute("y", corner.y)
             + attribute("width", width) + attribute("height", height) + attributes(style) + "/>\n";
}

void Svg::text(Point at, std::string_view text, const Style& style) {
  shapes_ += "<text" + attribute("x", at.x) + attribute("y", at.y) + attributes(style) + ">"
             + escaped(text) + "</text>\n";
}

void Svg::upward_text(Point at, std::string_view text, const Style& style) {
  const auto turn = "rotate(-90 " + number(at.x) + " " + number(at.y) + ")";
  shapes_ += "<text" + attribute("x", at.x) + attribute("y", at.y) + attribute("transform", turn)
             + attributes(style) + ">" + escaped(text) + "</text>\n";
}

std::string Svg::with_name_space(std::string_view name_space) const {
  const auto width = number(width_), height = number(height_);
  // Assistive technology takes an image for one thing and hides the links in it.
  const std::string_view role = has_links_ ? "group" : "img";
  return "<svg" + attribute("xmlns", name_space) + attribute("width", width)
         + attribute("height", height) + attribute("viewBox", "0 0 " + width + " " + height)
         + attribute("role", role) + " font-family=\"sans-serif\" font-size=\"12\">\n<title>"
         + escaped(description_) + "</title>\n" + shapes_ + "</svg>\n";
}

std::string Svg::element() const { return with_name_space(""); }

std::string Svg::file() const {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- Drawn by " + written_by() + ". -->\n"
         + with_name_space("http://www.w3.org/2000/svg");
}

}  // namespace riesel::io
