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

void draw_line(const FlowLine& line, const io::Look& look, io::Plot& plot) {
  std::vector<double> x, y;
  for (const FlowPoint& point : line.points) {
    x.push_back(point.x);
    y.push_back(point.mean.value);
  }
  plot.curve(x, y,
             {.stroke = look.colour,
              .stroke_width = 1.0,
              .dashes = line.leads_back ? std::string_view("5 4") : std::string_view()});
}

void draw_point(const FlowPoint& point, const io::Look& look, const std::string& up,
                io::Plot& plot) {
  plot.svg().begin_link(up + point.directory, point.tip);
  plot.measured(point.x, point.mean.value, point.mean.error, look,
                point.state == SteadyVerdict::steady);
  if (point.state == SteadyVerdict::accelerating) plot.arrow_up(point.x, point.mean.value, look);
  if (point.verdict == Validity::unphysical)
    plot.cross(point.x, point.mean.value, {.colour = ink::red});
  plot.svg().end_link();
}

/// The means and the ends of their error bars. Lower ends below zero, which a logarithmic axis
/// cannot show, are included only if `with_ends_below_zero`.
std::vector<double> extent_of(std::span<const FlowCurve> curves, bool with_ends_below_zero) {
  std::vector<double> values;
  for (const FlowCurve& curve : curves)
    for (const FlowLine& line : curve.lines)
      for (const FlowPoint& point : line.points) {
        const io::Measured& mean = point.mean;
        values.push_back(mean.value);
        if (!std::isfinite(mean.error)) continue;
        values.push_back(mean.value + mean.error);
        const double low = mean.value - mean.error;
        if (low > 0.0 || mean.value <= 0.0 || with_ends_below_zero) values.push_back(low);
      }
  return values;
}

/// Logarithmic if the means are far enough apart, even if error bars reach below zero.
io::Axis axis_of_means(const std::string& label, std::span<const FlowCurve> curves) {
  io::Axis axis = io::axis_for(label, extent_of(curves, false));
  if (axis.scale == io::Scale::linear) axis = io::axis_for(label, extent_of(curves, true));
  return axis;
}

std::vector<double> settings_of(std::span<const FlowCurve> curves) {
  std::vector<double> values;
  for (const FlowCurve& curve : curves)
    for (const FlowLine& line : curve.lines)
      for (const FlowPoint& point : line.points) values.push_back(point.x);
  return values;
}

/// The values at those points for which `is_part` holds; elsewhere NaN, which leaves a gap.
template <class IsPart>
std::vector<double> pieces(const ImpactLine& line, double io::CurvePoint::*value, IsPart is_part) {
  std::vector<double> y;
  for (std::size_t i = 0; i < line.points.size(); ++i)
    y.push_back(is_part(i) ? line.points[i].*value : unknown);
  return y;
}

/// Full between points that are not unphysical; dashed where one end or both are.
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

const FlowQuantity& judged_quantity(bool by_temperature) {
  using Flow = io::FlowSummary;
  static const FlowQuantity velocity{
      "mean_axial_velocity", "Mean axial velocity", "m/s",
      [](const Flow& flow) -> const io::Measured& { return flow.mean_axial_velocity; }};
  static const FlowQuantity temperature{
      "granular_temperature", "Granular temperature", "m^2/s^2",
      [](const Flow& f) -> const io::Measured& { return f.fluctuations.granular_temperature; }};
  return by_temperature ? temperature : velocity;
}

io::Svg draw_flows(const std::string& title, const std::string& x_label,
                   const FlowQuantity& quantity, std::span<const FlowCurve> curves,
                   const std::string& up) {
  io::Plot plot(figure_width, tall_figure,
                description_of(quantity.heading + " against " + x_label, title),
                io::axis_for(x_label, settings_of(curves)),
                io::with_room_above(axis_of_means(quantity.label(), curves), room_for_arrows));
  for (std::size_t i = 0; i < curves.size(); ++i)
    for (const FlowLine& line : curves[i].lines) draw_line(line, io::look_of(i), plot);
  plot.svg().begin_group("points");
  for (std::size_t i = 0; i < curves.size(); ++i)
    for (const FlowLine& line : curves[i].lines)
      for (const FlowPoint& point : line.points) draw_point(point, io::look_of(i), up, plot);
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
