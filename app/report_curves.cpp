#include "app/report_curves.hpp"

#include "app/report_parts.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace riesel::app {

namespace {

constexpr double room_for_arrows = 0.06;  // of the axis

using Legend = std::vector<std::pair<std::string, io::Look>>;

std::string description_of(const std::string& what, const std::string& title) {
  if (title.empty()) return what;
  return (what.ends_with('.') ? what.substr(0, what.size() - 1) : what) + ": " + title;
}

template <class Curve>
Legend legend_of(std::span<const Curve> curves) {
  Legend legend;
  for (std::size_t i = 0; i < curves.size(); ++i)
    if (!curves[i].name.empty()) legend.emplace_back(curves[i].name, io::look_of(i));
  return legend;
}

void draw_line(const VelocityLine& line, const io::Look& look, io::Plot& plot) {
  std::vector<double> x, y;
  for (const VelocityPoint& point : line.points) {
    x.push_back(point.x);
    y.push_back(point.velocity.value);
  }
  plot.curve(x, y,
             {.stroke = look.colour,
              .stroke_width = 1.0,
              .dashes = line.leads_back ? std::string_view("5 4") : std::string_view()});
}

void draw_point(const VelocityPoint& point, const io::Look& look, const std::string& up,
                io::Plot& plot) {
  plot.svg().begin_link(up + point.directory, point.tip);
  plot.measured(point.x, point.velocity.value, point.velocity.error, look, point.state == "steady");
  if (point.state == "accelerating") plot.arrow_up(point.x, point.velocity.value, look);
  if (point.verdict == Validity::unphysical)
    plot.cross(point.x, point.velocity.value, {.colour = ink::red});
  plot.svg().end_link();
}

/// What the axis of the velocities has to show, errors included as far as they leave it positive.
std::vector<double> extent_of(std::span<const VelocityCurve> curves) {
  std::vector<double> values;
  for (const VelocityCurve& curve : curves)
    for (const VelocityLine& line : curve.lines)
      for (const auto& [x, v, state, verdict, directory, tip] : line.points) {
        values.push_back(v.value);
        if (!std::isfinite(v.error)) continue;
        values.push_back(v.value + v.error);
        if (v.value - v.error > 0.0 || v.value <= 0.0) values.push_back(v.value - v.error);
      }
  return values;
}

std::vector<double> settings_of(std::span<const VelocityCurve> curves) {
  std::vector<double> values;
  for (const VelocityCurve& curve : curves)
    for (const VelocityLine& line : curve.lines)
      for (const VelocityPoint& point : line.points) values.push_back(point.x);
  return values;
}

/// The values at those points of which `is_part` holds; elsewhere unknown: a gap.
template <class IsPart>
std::vector<double> pieces(const ImpactLine& line, double io::CurvePoint::*value, IsPart is_part) {
  std::vector<double> y;
  for (std::size_t i = 0; i < line.points.size(); ++i)
    y.push_back(is_part(i) ? line.points[i].*value : unknown);
  return y;
}

/// Full between points that are good; dashed where an end or both ends are unphysical.
void draw_line(const ImpactLine& line, const ImpactQuantity& quantity, const io::Look& look,
               io::Plot& plot) {
  const auto& points = line.points;
  const auto is_bad = [&](std::size_t i) {
    return i < points.size() && points[i].verdict == Validity::unphysical;
  };
  std::vector<double> x;
  for (const io::CurvePoint& point : points) x.push_back(point.v_y);
  plot.curve(x, pieces(line, quantity.value, [&](std::size_t i) { return !is_bad(i); }),
             {.stroke = look.colour, .stroke_width = 2.0});
  plot.curve(
      x,
      pieces(line, quantity.value,
             [&](std::size_t i) { return is_bad(i) || is_bad(i + 1) || (i > 0 && is_bad(i - 1)); }),
      {.stroke = look.colour, .stroke_width = 1.5, .dashes = "5 4"});
}

}  // namespace

io::Svg draw_velocities(const std::string& title, const std::string& x_label,
                        std::span<const VelocityCurve> curves, const std::string& up) {
  io::Plot plot(figure_width, tall_figure,
                description_of("Mean axial velocity against " + x_label, title),
                io::axis_for(x_label, settings_of(curves)),
                io::with_room_above(io::axis_for("mean axial velocity (m/s)", extent_of(curves)),
                                    room_for_arrows));
  for (std::size_t i = 0; i < curves.size(); ++i)
    for (const VelocityLine& line : curves[i].lines) draw_line(line, io::look_of(i), plot);
  plot.svg().begin_group("points");
  for (std::size_t i = 0; i < curves.size(); ++i)
    for (const VelocityLine& line : curves[i].lines)
      for (const VelocityPoint& point : line.points) draw_point(point, io::look_of(i), up, plot);
  plot.svg().end_group();
  plot.legend(title, legend_of(curves), true);
  return plot.svg();
}

const std::vector<ImpactQuantity>& impact_quantities() {
  static const std::vector<ImpactQuantity> quantities = {
      {"dv_y", "loss of axial velocity (m/s)", "Loss of axial velocity in an impact.",
       &io::CurvePoint::dv_y},
      {"contacts", "contacts per impact", "Contacts begun in an impact.",
       &io::CurvePoint::contacts},
      {"dv_x", "dv_x (m/s)", "Velocity away from the wall after the impact plus v_x before it.",
       &io::CurvePoint::dv_x},
      {"max_overlap", "largest overlap (m)", "Largest overlap in an impact.",
       &io::CurvePoint::max_overlap},
  };
  return quantities;
}

io::Svg draw_impacts(const std::string& title, const ImpactQuantity& quantity,
                     std::span<const ImpactLine> lines) {
  std::vector<double> x, y;
  for (const ImpactLine& line : lines)
    for (const io::CurvePoint& point : line.points) {
      x.push_back(point.v_y);
      y.push_back(point.*quantity.value);
    }
  io::Plot plot(figure_width, tall_figure, description_of(quantity.doc, title),
                io::axis_for("axial velocity v_y before the impact (m/s)", x),
                io::axis_for(quantity.label, y));
  for (std::size_t i = 0; i < lines.size(); ++i)
    draw_line(lines[i], quantity, io::look_of(i), plot);
  plot.legend(title, legend_of(lines), false);
  return plot.svg();
}

}  // namespace riesel::app
