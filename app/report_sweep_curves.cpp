#include "app/report_sweep_curves.hpp"

#include "app/cell_text.hpp"
#include "app/plain_words.hpp"
#include "app/report_impacts.hpp"
#include "app/report_panels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace riesel::app {

namespace {

using Marks = std::vector<Mark>;

bool is_seed(const io::VariedSetting& setting) { return setting.key == "seed"; }

bool is_number(const io::Cell& cell) { return std::holds_alternative<double>(cell); }

/// Whether a setting can be the axis of a figure: its values are numbers, and it is not the seed.
bool can_be_axis(const io::Manifest& manifest, std::size_t setting) {
  return !is_seed(manifest.varied[setting])
         && std::ranges::all_of(manifest.points,
                                [&](const auto& p) { return is_number(p.values[setting]); });
}

std::size_t number_of_values(const io::Manifest& manifest, std::size_t setting) {
  std::set<io::Cell> values;
  for (const io::ManifestPoint& point : manifest.points) values.insert(point.values[setting]);
  return values.size();
}

/// The setting in which points differ from the neighbours that they continue.
std::optional<std::size_t> continued_axis(const io::Manifest& manifest) {
  for (const io::ManifestPoint& point : manifest.points) {
    if (point.parent.empty()) continue;
    const auto parent = std::ranges::find(manifest.points, point.parent, &io::ManifestPoint::name);
    if (parent == manifest.points.end()) continue;
    for (std::size_t i = 0; i < manifest.varied.size(); ++i)
      if (point.values[i] != parent->values[i] && can_be_axis(manifest, i)) return i;
  }
  return std::nullopt;
}

/// Whether each value on the axis comes with just one value of the other setting, as where an axis
/// of the sweep file varies the two together.
bool follows_from(const io::Manifest& manifest, std::size_t axis, std::size_t other) {
  std::map<io::Cell, io::Cell> other_of;
  return std::ranges::all_of(manifest.points, [&](const io::ManifestPoint& point) {
    return other_of.emplace(point.values[axis], point.values[other]).first->second
           == point.values[other];
  });
}

/// Whether each branch comes with just one value of the setting, so that its name says enough.
bool follows_from_branch(const io::Manifest& manifest, std::size_t setting) {
  std::map<std::string, io::Cell> value_of;
  return std::ranges::all_of(manifest.points, [&](const io::ManifestPoint& point) {
    return !point.branch.empty()
           && value_of.emplace(point.branch, point.values[setting]).first->second
                  == point.values[setting];
  });
}

/// For each varied setting whether it marks a curve: it varies, and follows neither from the axis,
/// if there is one, nor from the branch. Flows of several seeds belong to one curve.
std::vector<bool> told_beside(const io::Manifest& manifest, std::optional<std::size_t> axis) {
  std::vector<bool> told;
  for (std::size_t i = 0; i < manifest.varied.size(); ++i)
    told.push_back(
        number_of_values(manifest, i) > 1 && !follows_from_branch(manifest, i)
        && (!axis
            || (i != *axis && !is_seed(manifest.varied[i]) && !follows_from(manifest, *axis, i))));
  return told;
}

/// Names and values of the `told` settings, and the branch if the sweep has any: all points have
/// the same marks.
Marks marks_of(const io::Manifest& manifest, const io::ManifestPoint& point,
               const std::vector<bool>& told) {
  Marks marks;
  for (std::size_t i = 0; i < manifest.varied.size(); ++i)
    if (told[i])
      marks.push_back({.name = io::name_in_section(manifest.varied[i].key),
                       .value = text_of(point.values[i], manifest.varied[i].unit)});
  const bool any_branch = std::ranges::any_of(
      manifest.points, [](const io::ManifestPoint& other) { return !other.branch.empty(); });
  if (any_branch) marks.push_back({.name = "", .value = point.branch.empty() ? "-" : point.branch});
  return marks;
}

FlowPoint flow_point(const SweepRecord& record, std::size_t index, std::size_t axis,
                     const FlowQuantity& quantity) {
  const io::ManifestPoint& point = record.manifest.points[index];
  const SweepResult& result = record.results[index];
  const auto& flow = std::get<io::FlowSummary>(*result.summary);
  const Validity verdict = flow.validity.verdict.verdict;
  return {.x = std::get<double>(point.values[axis]),
          .mean = quantity.of(flow),
          .state = flow.state,
          .verdict = verdict,
          .directory = result.directory + "/" + (result.has_report ? report_name : ""),
          .tip = fmt::format("{}: {}, {}, {}", description_of(record.manifest, point),
                             with_error(quantity.of(flow), quantity.unit), name(flow.state),
                             name(verdict))};
}

/// What distinguishes the lines of a curve: leg and seed.
std::string line_of(const io::Manifest& manifest, const io::ManifestPoint& point) {
  std::string line = point.leg;
  for (std::size_t i = 0; i < manifest.varied.size(); ++i)
    if (is_seed(manifest.varied[i])) line += " " + text_of(point.values[i]);
  return line;
}

FlowCurve curve_of(const SweepRecord& record, std::size_t axis, const FlowQuantity& quantity,
                   const std::vector<std::size_t>& indices) {
  std::map<std::string, FlowLine> lines;
  for (const std::size_t i : indices) {
    const io::ManifestPoint& point = record.manifest.points[i];
    FlowLine& line = lines[line_of(record.manifest, point)];
    line.leads_back = point.leg == "backward";
    line.points.push_back(flow_point(record, i, axis, quantity));
  }
  FlowCurve curve;
  for (auto& [name, line] : lines) {
    std::ranges::stable_sort(line.points, {}, &FlowPoint::x);
    curve.lines.push_back(std::move(line));
  }
  return curve;
}

}  // namespace

std::optional<std::size_t> axis_of(const io::Manifest& manifest) {
  if (const auto continued = continued_axis(manifest)) return continued;
  std::optional<std::size_t> axis;
  std::size_t most = 1;
  for (std::size_t i = 0; i < manifest.varied.size(); ++i) {
    if (!can_be_axis(manifest, i) || number_of_values(manifest, i) <= most) continue;
    most = number_of_values(manifest, i);
    axis = i;
  }
  return axis;
}

std::vector<FlowPanel> flow_panels(const SweepRecord& record, std::size_t axis,
                                   const FlowQuantity& quantity) {
  const std::vector<bool> told = told_beside(record.manifest, axis);
  std::vector<Marks> curves;
  std::vector<std::vector<std::size_t>> runs;
  for (std::size_t i = 0; i < record.results.size(); ++i) {
    if (record.results[i].as<io::FlowSummary>() == nullptr) continue;
    const Marks marks = marks_of(record.manifest, record.manifest.points[i], told);
    const auto place = std::ranges::find(curves, marks) - curves.begin();
    if (place == std::ssize(curves)) {
      curves.push_back(marks);
      runs.emplace_back();
    }
    runs[static_cast<std::size_t>(place)].push_back(i);
  }
  std::vector<FlowPanel> panels;
  for (const Panel& panel : panels_of(curves)) {
    panels.push_back({.title = panel.title, .curves = {}});
    for (std::size_t i = 0; i < panel.curves.size(); ++i) {
      panels.back().curves.push_back(curve_of(record, axis, quantity, runs[panel.curves[i]]));
      panels.back().curves.back().name = panel.names[i];
    }
  }
  return panels;
}

std::vector<ImpactPanel> impact_panels(const SweepRecord& record) {
  const std::vector<bool> told = told_beside(record.manifest, std::nullopt);
  std::vector<Marks> marks;
  std::vector<ImpactLine> lines;
  for (std::size_t i = 0; i < record.results.size(); ++i) {
    const auto* summary = record.results[i].as<io::CurveSummary>();
    if (summary == nullptr) continue;
    for (ImpactLine& line : impact_lines(*summary)) {
      marks.push_back(marks_of(record.manifest, record.manifest.points[i], told));
      marks.back().push_back({.name = "v_x", .value = text_of(line.points.front().v_x, "m/s")});
      lines.push_back(std::move(line));
    }
  }
  std::vector<ImpactPanel> panels;
  for (const Panel& panel : panels_of(marks)) {
    panels.push_back({.title = panel.title, .lines = {}});
    for (std::size_t i = 0; i < panel.curves.size(); ++i) {
      panels.back().lines.push_back(std::move(lines[panel.curves[i]]));
      panels.back().lines.back().name = panel.names[i];
    }
  }
  return panels;
}

std::string description_of(const io::Manifest& manifest, const io::ManifestPoint& point) {
  std::string text;
  for (const Mark& mark : marks_of(manifest, point, std::vector(manifest.varied.size(), true)))
    text += (text.empty() ? "" : ", ") + mark.name + (mark.name.empty() ? "" : " ") + mark.value;
  return text + (point.leg.empty() ? "" : ", " + point.leg);
}

}  // namespace riesel::app
