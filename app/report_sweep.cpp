#include "app/report_sweep.hpp"

#include "app/cell_text.hpp"
#include "app/plain_words.hpp"
#include "app/report_impacts.hpp"
#include "app/report_sweep_curves.hpp"
#include "io/settings_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace riesel::app {

namespace {

/// Removes columns that are empty below the head, such as those of branches and legs.
io::HtmlRows without_empty_columns(const io::HtmlRows& rows) {
  io::HtmlRows kept(rows.size());
  for (std::size_t column = 0; column < rows.front().size(); ++column) {
    const auto is_empty = [&](const auto& row) { return row[column].text.empty(); };
    if (std::all_of(rows.begin() + 1, rows.end(), is_empty)) continue;
    for (std::size_t i = 0; i < rows.size(); ++i) kept[i].push_back(rows[i][column]);
  }
  return kept;
}

class SweepReport {
public:
  explicit SweepReport(const SweepRecord& record)
      : record_(&record),
        draft_("riesel: sweep of " + scenario()),
        quantity_(&judged_quantity(all_by_temperature())) {}

  Report make() && {
    tell_result();
    show_flows();
    show_impacts();
    list_points();
    page().heading("The sweep");
    page().folded("The sweep file", io::with_plain_line_ends(record_->sweep_file));
    return draft_.report();
  }

private:
  const io::Manifest& manifest() const { return record_->manifest; }
  io::HtmlPage& page() { return draft_.page(); }

  const io::FlowSummary* flow(std::size_t i) const {
    return record_->results[i].as<io::FlowSummary>();
  }

  std::string scenario() const {
    const auto& results = record_->results;
    const auto result =
        std::ranges::find_if(results, [](auto& r) { return r.summary.has_value(); });
    return std::visit([](auto& summary) { return summary.run.scenario; }, *result->summary);
  }

  void tell_result() {
    std::map<std::string, int> statuses, states, verdicts;
    int ended_at_most = 0;
    bool is_good = true;
    for (std::size_t i = 0; i < record_->results.size(); ++i) {
      ++statuses[manifest().points[i].status];
      const auto* summary = flow(i);
      if (summary == nullptr) continue;
      const Validity validity = summary->validity.verdict.verdict;
      ++states[std::string(name(summary->state))];
      ++verdicts[std::string(name(validity))];
      if (summary->state != SteadyVerdict::steady || validity != Validity::valid) is_good = false;
      if (summary->ended_by == io::EndedBy::at_most) ++ended_at_most;
    }
    page().paragraph(
        fmt::format("{}: {}.", so_many(std::ssize(manifest().points), "point"), counted(statuses)));
    if (states.empty()) return;
    page().paragraph(fmt::format("State of the flows: {}. Validity: {}.{}", counted(states),
                                 counted(verdicts),
                                 is_good ? ""
                                         : " Only a steady and valid mean is a property of the "
                                           "flow of hard grains."),
                     is_good ? "good" : "doubtful");
    if (ended_at_most > 0)
      page().paragraph(fmt::format("{} of them ended at run.until.at_most, before the mean reached "
                                   "the requested precision in two successive checks.",
                                   ended_at_most),
                       "doubtful");
  }

  /// The file name of one of several figures.
  static std::string numbered(const std::string& name, std::size_t i, std::size_t of) {
    return of == 1 ? name : fmt::format("{}_{}", name, i + 1);
  }

  /// Whether all flows are judged by their temperature. If gravity drives any of them along the
  /// walls, it is judged by its velocity, and all are shown by their velocities.
  bool all_by_temperature() const {
    bool any = false;
    for (std::size_t i = 0; i < record_->results.size(); ++i) {
      const auto* summary = flow(i);
      if (summary != nullptr && summary->judged_by != io::JudgedBy::granular_temperature)
        return false;
      any = any || summary != nullptr;
    }
    return any;
  }

  void show_flows() {
    if (scenario_has_curves()) return;
    page().heading(quantity_->heading);
    const auto axis = axis_of(manifest());
    if (!axis) {
      page().paragraph("There is no figure: no numeric setting is varied.");
      return;
    }
    const io::VariedSetting& setting = manifest().varied[*axis];
    const std::string label = with_unit(setting.key, setting.unit);
    page().paragraph(what_symbols_mean());
    const auto panels = flow_panels(*record_, *axis, *quantity_);
    for (std::size_t i = 0; i < panels.size(); ++i)
      draft_.add_figure(numbered(quantity_->name, i, panels.size()),
                        draw_flows(panels[i].title, label, *quantity_, panels[i].curves, ""),
                        draw_flows(panels[i].title, label, *quantity_, panels[i].curves, "../"),
                        quantity_->heading + " against " + setting.key + ".");
  }

  /// Explains the symbols of draw_flows().
  std::string what_symbols_mean() const {
    const bool has_legs = std::ranges::any_of(
        manifest().points, [](const io::ManifestPoint& point) { return !point.leg.empty(); });
    return std::string(
               "Means after the transient, with 68 % error bars. Full symbols: steady. Open: not "
               "steady, no property of the flow. Arrows: still accelerating, of no known error. "
               "Red crosses: unphysical, an artefact of soft contacts. A click leads to the run. "
               "Lines join runs of one seed and are there to guide the eye.")
           + (has_legs ? " Full lines: the way there along the axis; dashed: the way back." : "");
  }

  bool scenario_has_curves() const {
    return std::ranges::any_of(record_->results, [](const SweepResult& result) {
      return result.summary && result.as<io::FlowSummary>() == nullptr;
    });
  }

  void show_impacts() {
    const auto panels = impact_panels(*record_);
    if (panels.empty()) return;
    page().heading("Impacts");
    page().paragraph(what_dashes_mean());
    for (std::size_t i = 0; i < panels.size(); ++i)
      for (std::size_t q = 0; q < 2; ++q) {  // those of the paper; the others are in the runs
        const ImpactQuantity& quantity = impact_quantities()[q];
        draft_.add_figure(numbered(quantity.name, i, panels.size()),
                          draw_impacts(panels[i].title, quantity, panels[i].lines), quantity.doc);
      }
  }

  void list_points() {
    page().heading("Points");
    std::vector<io::HtmlCell> head = {"point"};
    for (const io::VariedSetting& setting : manifest().varied)
      head.emplace_back(with_unit(io::name_in_section(setting.key), setting.unit));
    for (const char* name : {"branch", "leg"}) head.emplace_back(name);
    const std::vector<std::string> of_results =
        scenario_has_curves() ? std::vector<std::string>{"points of the curve", "left out",
                                                         "validity of these points"}
                              : std::vector<std::string>{quantity_->label(), "state", "validity",
                                                         "brake failure", "n_dot dv_y / g"};
    for (const std::string& name : of_results) head.emplace_back(name);
    for (const char* name : {"report", "status"}) head.emplace_back(name);
    io::HtmlRows rows = {head};
    for (std::size_t i = 0; i < record_->results.size(); ++i)
      rows.push_back(row_of(i, head.size()));
    page().table(without_empty_columns(rows));
  }

  /// The row of a point; has as many cells as the head.
  std::vector<io::HtmlCell> row_of(std::size_t i, std::size_t cells) const {
    const io::ManifestPoint& point = manifest().points[i];
    const SweepResult& result = record_->results[i];
    std::vector<io::HtmlCell> row = {{point.name, result.directory + "/"}};
    for (const io::Cell& value : point.values) row.emplace_back(text_of(value));
    row.emplace_back(point.branch);
    row.emplace_back(point.leg);
    if (const auto* summary = result.as<io::FlowSummary>()) add_flow(*summary, row);
    if (const auto* summary = result.as<io::CurveSummary>()) add_curve(*summary, row);
    if (const auto* summary = result.as<io::ColumnSummary>()) add_column(*summary, row);
    row.resize(cells - 2, "");
    row.push_back(result.has_report ? io::HtmlCell("report", result.directory + "/" + report_name)
                                    : io::HtmlCell(""));
    const std::string& reason = result.flaw.empty() ? point.reason : result.flaw;
    row.emplace_back(point.status + (reason.empty() ? "" : ": " + reason));
    return row;
  }

  void add_flow(const io::FlowSummary& s, std::vector<io::HtmlCell>& row) const {
    const io::Measured& carried = s.balance.n_dot_dv_y;
    row.emplace_back(with_error(quantity_->of(s), ""));
    row.emplace_back(std::string(name(s.state)));
    row.emplace_back(std::string(name(s.validity.verdict.verdict)));
    row.emplace_back(number(s.validity.verdict.value_of("brake_failure_fraction"), "{:.2g}"));
    // If gravity does not pull along the walls, there is nothing to compare with.
    const double g = s.balance.gravity;
    row.emplace_back(
        g == 0.0 ? "" : with_error({.value = carried.value / g, .error = carried.error / g}, ""));
  }

  static void add_curve(const io::CurveSummary& s, std::vector<io::HtmlCell>& row) {
    const LeftOut left_out = left_out_of(s);
    row.emplace_back(std::to_string(s.curve.size()));
    row.emplace_back(std::to_string(left_out.passed + left_out.stuck));
    row.emplace_back(count_of_verdicts(s));
  }

  static void add_column(const io::ColumnSummary& s, std::vector<io::HtmlCell>& row) {
    const auto given_up = [](const io::ColumnPoint& p) { return std::isnan(p.restitution); };
    row.emplace_back(std::to_string(s.column.size()));
    row.emplace_back(std::to_string(std::ranges::count_if(s.column, given_up)));
    row.emplace_back(count_of_verdicts(s));
  }

  const SweepRecord* record_;
  ReportDraft draft_;
  const FlowQuantity* quantity_;  // of flows
};

}  // namespace

Report make_report(const SweepRecord& record) { return SweepReport(record).make(); }

}  // namespace riesel::app
