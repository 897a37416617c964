#include "app/report_impacts.hpp"

#include "app/curve_lines.hpp"
#include "app/plain_words.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <utility>

namespace riesel::app {

namespace {

void tell_result(const io::CurveSummary& summary, io::HtmlPage& page) {
  const auto points = static_cast<std::int64_t>(summary.curve.size());
  page.paragraph(
      fmt::format("{}, each the mean over its starting places, but for the largest overlap.",
                  so_many(points, "point")));
  page.paragraph("Validity of the points: " + count_of_verdicts(summary) + ".",
                 class_of(worst_of(summary.curve)));
  for (const CurveReason& reason : reasons_of(summary)) {
    page.paragraph(fmt::format("{}: {}.", name(reason.verdict), reason.text));
    page.list(reason.places);
  }
  const auto [passed, stuck] = left_out_of(summary);
  if (passed + stuck > 0)
    page.paragraph(fmt::format("{} impacts went through the wall and {} never came away from it: "
                               "they are left out of the means.",
                               passed, stuck),
                   "doubtful");
}

void show_curves(const io::CurveSummary& summary, ReportDraft& draft) {
  std::vector<ImpactLine> lines = impact_lines(summary);
  if (lines.size() > 1)
    for (ImpactLine& line : lines)
      line.name = fmt::format("v_x = {:.6g} m/s", line.points.front().v_x);
  draft.page().heading("Curves");
  draft.page().paragraph(what_dashes_mean());
  for (const ImpactQuantity& quantity : impact_quantities())
    draft.add_figure(quantity.name, draw_impacts("", quantity, lines), quantity.doc);
}

void list_points(const io::CurveSummary& summary, io::HtmlPage& page) {
  page.heading("Points");
  io::HtmlRows rows = {{"v_x (m/s)", "v_y (m/s)", "dv_y (m/s)", "dv_x (m/s)", "contacts",
                        "cut short", "brake failure", "overlap (m)", "passed", "stuck",
                        "validity"}};
  for (const io::CurvePoint& p : summary.curve)
    rows.push_back({number(p.v_x), number(p.v_y), number(p.dv_y), number(p.dv_x),
                    number(p.contacts), number(p.cut_short),
                    number(p.brake_failure_fraction, "{:.3g}"), number(p.max_overlap, "{:.3g}"),
                    std::to_string(p.passed), std::to_string(p.stuck),
                    std::string(name(p.verdict))});
  page.table(rows);
}

}  // namespace

std::vector<ImpactLine> impact_lines(const io::CurveSummary& summary) {
  std::vector<ImpactLine> lines;
  for (auto& points : points_by_v_x(summary.curve))
    lines.push_back({.name = "", .points = std::move(points)});
  return lines;
}

std::string what_dashes_mean() {
  return fmt::format(
      "Lines are dashed, and single points open, where the result is unphysical: more than {:g} of "
      "the braking is done by "
      "contacts that are passed through before they can push (brake failure), grains sink into "
      "each other by more than {:g} of the smaller radius, or errors of the time step make or take "
      "more than {:g} of the energy.",
      unphysical_brake_failure, unphysical_overlap_ratio, unphysical_energy_error);
}

Report make_report(const ImpactRecord& record) {
  return report_of(record, tell_result, show_curves, list_points);
}

}  // namespace riesel::app
