#include "app/report_figures.hpp"

#include "app/report_parts.hpp"
#include "io/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace riesel::app {

namespace {

constexpr std::string_view orange = "#d9730d", pale_orange = "#f9dcc0", pale_grey = "#eeeeee";

std::string label_of(const io::Column& column) { return with_unit(column.name, column.unit); }

/// A value and, if its error is known, the ends of its bar.
void add(const io::Measured& m, std::vector<double>& extent) {
  extent.push_back(m.value);
  if (std::isfinite(m.error)) extent.insert(extent.end(), {m.value - m.error, m.value + m.error});
}

/// The range of the values and of the mean with its error.
io::Interval range_with(std::vector<double> values, const std::optional<io::Measured>& mean) {
  if (mean) add(*mean, values);
  return io::range_of(values);
}

}  // namespace

void mark_transient(double end, io::Plot& plot) {
  if (end <= 0.0) return;
  plot.area({plot.x().range.low, end}, plot.y().range, {.fill = pale_grey});
  plot.marker(end, "end of the transient", {.stroke = ink::grey, .dashes = "4 3"});
}

io::Svg draw_series(const io::Series& time, const io::Series& series, const SeriesMarks& marks) {
  io::Plot plot(figure_width, 250.0, series.column.doc,
                {.label = label_of(time.column), .range = io::range_of(time.values)},
                {.label = label_of(series.column), .range = range_with(series.values, marks.mean)});
  const io::Interval after{marks.transient_end, plot.x().range.high};
  mark_transient(marks.transient_end, plot);
  if (marks.mean && std::isfinite(marks.mean->error))
    plot.area(after, {marks.mean->value - marks.mean->error, marks.mean->value + marks.mean->error},
              {.fill = pale_orange});
  plot.curve(time.values, series.values, {.stroke = ink::blue, .stroke_width = 1.2});
  if (marks.mean) plot.level(after, marks.mean->value, {.stroke = orange, .stroke_width = 1.5});
  return plot.svg();
}

io::Svg draw_profiles(const io::Profiles& profiles, const std::vector<std::string>& names,
                      const std::string& label) {
  std::vector<double> extent;
  std::vector<std::pair<std::string, io::Look>> legend;
  for (const std::string& name : names) {
    const io::ProfileWithErrors& profile = profiles.named(name);
    legend.emplace_back(name, io::look_of(legend.size()));
    for (std::size_t i = 0; i < profile.values.size(); ++i)
      add({.value = profile.values[i], .error = profile.errors[i]}, extent);
  }
  io::Plot plot(figure_width, 300.0, label + " across the flow",
                {.label = "x (m)", .range = io::range_of(profiles.x)},
                {.label = label, .range = io::range_of(extent)});
  for (const auto& [name, look] : legend) {
    const io::ProfileWithErrors& profile = profiles.named(name);
    plot.curve(profiles.x, profile.values, {.stroke = look.colour, .stroke_width = 1.0});
    for (std::size_t i = 0; i < profile.values.size(); ++i)
      plot.measured(profiles.x[i], profile.values[i], profile.errors[i], look, true);
  }
  plot.legend("", legend, true);
  return plot.svg();
}

std::vector<EnergyPart> parts_of(const io::FlowSummary::Energy& e) {
  std::vector<EnergyPart> parts = {{"at the start", e.initial, true},
                                   {"work of gravity", e.gravity_work, true}};
  if (e.wall_work != 0.0) parts.push_back({"work of the walls", e.wall_work, true});
  parts.push_back({"kinetic, at the end", e.kinetic, false});
  if (e.rotational != 0.0) parts.push_back({"of rotation, at the end", e.rotational, false});
  parts.insert(parts.end(), {{"elastic, at the end", e.elastic, false},
                             {"lost by normal damping", e.normal_loss, false},
                             {"lost by friction", e.friction_loss, false},
                             {"residual", e.residual, false}});
  return parts;
}

io::Svg draw_energy(const std::vector<EnergyPart>& parts) {
  constexpr double left = 190.0, right_margin = 90.0, row = 24.0, bar = 16.0;
  double low = 0.0, high = 0.0;
  for (const EnergyPart& part : parts) {
    low = std::min(low, part.value);
    high = std::max(high, part.value);
  }
  const double scale = (figure_width - left - right_margin) / (high > low ? high - low : 1.0);
  const double zero = left - low * scale;
  const double height = row * static_cast<double>(parts.size()) + 8.0;

  io::Svg svg(figure_width, height, "The budget of energy");
  double y = 4.0;
  for (const EnergyPart& part : parts) {
    const double length = std::abs(part.value) * scale;
    const double begin = part.value < 0.0 ? zero - length : zero;
    svg.text({left - 10.0, y + 13.0}, part.name, {.anchor = "end"});
    svg.rectangle({begin, y}, length, bar, {.fill = part.came_in ? ink::blue : orange});
    svg.text({begin + length + 6.0, y + 13.0}, fmt::format("{:.3g} J", part.value));
    y += row;
  }
  svg.line({zero, 0.0}, {zero, height}, {.stroke = ink::grey});
  return svg;
}

io::Svg draw_visits(std::span<const std::int64_t> of_contacts) {
  const auto most = static_cast<double>(*std::ranges::max_element(of_contacts));
  const auto last = static_cast<double>(of_contacts.size());
  io::Plot plot(figure_width, 250.0, "Contacts per visit to a wall",
                {.label = fmt::format("contacts of the visit ({}: as many or more)", last),
                 .range = {0.4, last + 0.6}},
                {.label = "visits", .range = {0.0, 1.08 * std::max(most, 1.0)}});
  plot.svg().begin_group("bars", {.fill = ink::blue});
  for (std::size_t i = 0; i < of_contacts.size(); ++i) {
    const double contacts = static_cast<double>(i) + 1.0;
    plot.area({contacts - 0.4, contacts + 0.4}, {0.0, static_cast<double>(of_contacts[i])}, {});
  }
  plot.svg().end_group();
  return plot.svg();
}

}  // namespace riesel::app
