#include "app/report_column.hpp"

#include "app/plain_words.hpp"
#include "app/report_parts.hpp"
#include "io/plot.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace riesel::app {

namespace {

void tell_result(const io::ColumnSummary& s, io::HtmlPage& page) {
  page.paragraph(
      fmt::format("{}, {}.", so_many(s.run.grains, "bead"), so_many(std::ssize(s.column), "drop")));
  page.paragraph(fmt::format("Hard beads: {}.", description_of(s.rigid)));
  page.paragraph(fmt::format("Validity of the drops: {}. {}", count_of_verdicts(s), where_hard(s)),
                 class_of(worst_of(s.column)));
}

/// A value against the gap ratio, with the level of hard beads.
io::Svg draw(const io::ColumnSummary& s, double io::ColumnPoint::*value, double of_rigid,
             const std::string& label) {
  std::vector<double> x, y;
  for (const io::ColumnPoint& p : s.column) {
    x.push_back(p.gap_ratio);
    y.push_back(p.*value);
  }
  std::vector<double> all = y;
  all.push_back(of_rigid);
  io::Plot plot(figure_width, tall_figure, label + " against the gap between the beads",
                io::axis_for("gap / (v t_col)", x), io::axis_for(label, all));
  const io::Look look = io::look_of(0);
  plot.level(plot.x().range, of_rigid,
             {.stroke = look.colour, .stroke_width = 1.5, .dashes = "5 4"});
  for (std::size_t i = 0; i < x.size(); ++i) {
    plot.measured(x[i], y[i], unknown, look, s.column[i].verdict == Validity::valid);
    if (s.column[i].verdict == Validity::unphysical) plot.cross(x[i], y[i], {.colour = ink::red});
  }
  return plot.svg();
}

void show_curves(const io::ColumnSummary& s, ReportDraft& draft) {
  draft.page().heading("Curves");
  draft.page().paragraph(
      "Dashes: hard beads, which collide one after the other. Full symbols: valid. Open: suspect. "
      "Red crosses: unphysical.");
  draft.add_figure(
      "restitution",
      draw(s, &io::ColumnPoint::restitution, s.rigid.restitution, "effective restitution"),
      "Square root of the energy after over that before.");
  draft.add_figure("rebound", draw(s, &io::ColumnPoint::rebound, s.rigid.rebound, "rebound"),
                   "Velocity of the centre of mass after over that before, upwards.");
}

void list_points(const io::ColumnSummary& s, io::HtmlPage& page) {
  page.heading("Points");
  io::HtmlRows rows = {{"gap / (v t_col)", "gap (m)", "restitution", "rebound", "detachment",
                        "contacts", "overlap (m)", "validity"}};
  for (const io::ColumnPoint& p : s.column)
    rows.push_back({number(p.gap_ratio), number(p.gap), number(p.restitution), number(p.rebound),
                    number(p.detachment, "{:.3g}"), number(p.contacts),
                    number(p.max_overlap, "{:.3g}"), std::string(name(p.verdict))});
  page.table(rows);
}

}  // namespace

Report make_report(const ColumnRecord& record) {
  return report_of(record, tell_result, show_curves, list_points);
}

}  // namespace riesel::app
