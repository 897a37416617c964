#include "app/report_contacts.hpp"

#include "app/report_figures.hpp"
#include "engine/brake.hpp"
#include "io/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace riesel::app {

namespace {

constexpr std::string_view pale_blue = "#a9c1dd";

/// A marked value on the axis of a histogram.
struct HistogramMark {
  double at = 0.0;  ///< in the unit of the axis; NaN: not known, and not drawn
  std::string label;
};

/// Where bin `i` ends. The last bin is as wide as the one before, as bins of an octave are.
double upper_edge(const std::vector<double>& edges, std::size_t i) {
  return i + 1 < edges.size() ? edges[i + 1] : 2.0 * edges[i] - edges[i - 1];
}

/// The axis of values, with room for the filled bins and the marks.
io::Axis axis_of_values(const io::HistogramWithErrors& h, const std::string& label,
                        const std::vector<HistogramMark>& marks) {
  std::vector<double> shown;
  for (std::size_t i = 0; i < h.rates.size(); ++i)
    if (h.rates[i] > 0.0)
      shown.insert(shown.end(), {h.lower_edges[i], upper_edge(h.lower_edges, i)});
  for (const HistogramMark& mark : marks) shown.push_back(mark.at);
  return {.label = label,
          .range = io::range_of(shown, io::Scale::logarithmic),
          .scale = io::Scale::logarithmic};
}

/// The axis of rates, from below the smallest bar, with room for the labels of the marks.
io::Axis axis_of_rates(const io::HistogramWithErrors& h) {
  std::vector<double> filled;
  std::ranges::copy_if(h.rates, std::back_inserter(filled), [](double rate) { return rate > 0.0; });
  if (!filled.empty()) filled.push_back(0.5 * std::ranges::min(filled));
  for (std::size_t i = 0; i < h.rates.size(); ++i)
    if (h.rates[i] > 0.0 && std::isfinite(h.errors[i])) filled.push_back(h.rates[i] + h.errors[i]);
  io::Axis axis{.label = "per second",
                .range = io::range_of(filled, io::Scale::logarithmic),
                .scale = io::Scale::logarithmic};
  return io::with_room_above(axis, 0.3);
}

/// A threshold of a finding; NaN if the verdict, perhaps by another version, does not have it.
double threshold(const io::FlowSummary& summary, std::string_view finding, double Finding::*which) {
  const Finding* found = summary.validity.verdict.find(finding);
  return found == nullptr ? unknown : found->*which;
}

/// Converts thresholds, which refer to the radius of the smallest body, to those of the axis, which
/// refers to the sum of the radii.
std::vector<HistogramMark> marks_of_overlaps(const io::FlowSummary& summary,
                                             const io::FinalState& state, bool of_walls) {
  double smallest = std::ranges::min(state.grains, {}, &Grain::radius).radius;
  double reach = state.mean_diameter();
  if (of_walls && !state.walls.empty()) {
    const WallLattice& wall = state.walls.front();
    smallest = wall.smaller_radius(smallest);
    reach = 0.5 * state.mean_diameter() + wall.radius;
  }
  const double part = smallest / reach;
  return {{part * threshold(summary, "max_overlap_ratio", &Finding::suspect), "suspect"},
          {part * threshold(summary, "max_overlap_ratio", &Finding::unphysical), "unphysical"}};
}

std::vector<HistogramMark> marks_of_durations(const io::FlowSummary& summary, bool of_walls) {
  const auto& v = summary.validity;
  const double steps = threshold(summary, "steps_per_contact", &Finding::suspect);
  const double time_step = summary.time / static_cast<double>(summary.run.steps);
  std::vector<HistogramMark> marks = {{steps * time_step, fmt::format("{:.3g} steps", steps)}};
  if (of_walls) marks.push_back({cut_short_below * v.t_col_walls, "cut short below"});
  marks.push_back({of_walls ? v.t_col_walls : v.t_col_grains, "t_col"});
  return marks;
}

/// A wall, or both, and the series of the impulse that it has given to the grains.
struct Brake {
  std::string name, impulse;
};

std::vector<Brake> brakes_of(const io::FlowSummary::BrakingForce& force) {
  std::vector<Brake> brakes = {{left_wall_of(force), "left_wall_impulse_y"}};
  if (force.right)
    brakes.insert(brakes.end(),
                  {{right_wall, "right_wall_impulse_y"}, {"both walls", "wall_impulse_y"}});
  return brakes;
}

/// Times (s) and mean forces (N) of a wall, for each of at most `parts` parts of the rows.
std::array<std::vector<double>, 2> force_of(const io::Series& time, const io::Series& impulse,
                                            std::size_t parts) {
  std::array<std::vector<double>, 2> force;
  const auto& t = time.values;
  const std::size_t steps = t.empty() ? 0 : t.size() - 1;
  const std::size_t pieces = std::min(parts, steps);
  for (std::size_t i = 0; i < pieces; ++i) {
    const std::size_t a = i * steps / pieces, b = (i + 1) * steps / pieces;
    force[0].push_back(0.5 * (t[a] + t[b]));
    force[1].push_back(-(impulse.values[b] - impulse.values[a]) / (t[b] - t[a]));
  }
  return force;
}

/// Bars with errors on logarithmic axes. Marks that are not known are left out.
io::Svg draw_histogram(const io::HistogramWithErrors& h, const std::string& x_label,
                       std::vector<HistogramMark> marks) {
  std::erase_if(marks, [](const HistogramMark& mark) { return !std::isfinite(mark.at); });
  std::ranges::sort(marks, {}, &HistogramMark::at);  // as Plot::marker() asks for
  io::Plot plot(figure_width, 270.0, h.column.doc, axis_of_values(h, x_label, marks),
                axis_of_rates(h));
  plot.svg().begin_group("bars", {.fill = pale_blue, .stroke = ink::blue});
  for (std::size_t i = 0; i < h.rates.size(); ++i)
    if (h.rates[i] > 0.0)
      plot.area({h.lower_edges[i], upper_edge(h.lower_edges, i)}, {plot.y().range.low, h.rates[i]},
                {});
  plot.svg().end_group();
  plot.svg().begin_group("errors");
  for (std::size_t i = 0; i < h.rates.size(); ++i)
    if (h.rates[i] > 0.0)
      plot.error_bar(std::sqrt(h.lower_edges[i] * upper_edge(h.lower_edges, i)), h.rates[i],
                     h.errors[i], ink::blue);
  plot.svg().end_group();
  plot.svg().begin_group("marks");
  int row = static_cast<int>(marks.size());
  for (const HistogramMark& mark : marks)
    plot.marker(mark.at, mark.label,
                {.stroke = mark.label == "unphysical" ? ink::red : ink::grey, .dashes = "4 3"},
                --row);
  plot.svg().end_group();
  return plot.svg();
}

/// Mean forces (N, positive where they brake) over parts of the time, and the weight of all grains:
/// how much of it each wall carries depends on what presses the grains against it.
io::Svg draw_braking(const io::RunContents& run, const io::FlowSummary& summary) {
  constexpr std::size_t parts = 50;
  const io::Series& time = run.series_of("time");
  const std::vector<Brake> brakes = brakes_of(summary.braking_force);
  const bool with_weight = has_weight(summary.braking_force);
  std::vector<std::array<std::vector<double>, 2>> forces;
  std::vector<double> extent = {0.0};
  for (const Brake& brake : brakes) {
    forces.push_back(force_of(time, run.series_of(brake.impulse), parts));
    extent.insert(extent.end(), forces.back()[1].begin(), forces.back()[1].end());
  }
  if (with_weight) extent.push_back(summary.braking_force.weight);

  io::Plot plot(figure_width, 250.0,
                fmt::format("Braking force of {}", brake_of(summary.braking_force)),
                {.label = "time (s)", .range = io::range_of(time.values)},
                {.label = "braking force (N)", .range = io::range_of(extent)});
  mark_transient(summary.transient_end, plot);
  std::vector<std::pair<std::string, io::Look>> legend;
  for (std::size_t i = 0; i < brakes.size(); ++i) {
    legend.emplace_back(brakes[i].name, io::look_of(i));
    plot.curve(forces[i][0], forces[i][1],
               {.stroke = legend[i].second.colour, .stroke_width = 1.5});
  }
  if (with_weight)
    plot.level(plot.x().range, summary.braking_force.weight,
               {.stroke = ink::grey, .dashes = "5 4"});
  plot.legend("", legend, false);
  return plot.svg();
}

}  // namespace

std::string left_wall_of(const io::FlowSummary::BrakingForce& force) {
  return force.right ? "left wall" : "bottom";
}

std::string_view brake_of(const io::FlowSummary::BrakingForce& force) {
  return force.right ? "the walls" : "the bottom";
}

bool has_weight(const io::FlowSummary::BrakingForce& force) {
  return std::isfinite(force.weight) && force.weight != 0.0;
}

void show_braking(const io::RunContents& run, const io::FlowSummary& summary, ReportDraft& draft) {
  const auto& force = summary.braking_force;
  std::string caption =
      fmt::format("Axial force of {} on the grains, positive where it brakes, in means over parts "
                  "of the time.",
                  brake_of(force));
  if (has_weight(force))
    caption += fmt::format(" Dashed: the weight of all grains along {} in a steady state.",
                           force.right ? "the walls, which carry it together"
                                       : "the bottom, which carries it");
  draft.add_figure("braking", draw_braking(run, summary), caption);
}

void show_contacts(const io::RunContents& run, const io::FlowSummary& summary, ReportDraft& draft) {
  draft.page().heading("Contacts");
  for (const bool is_wall : {false, true}) {
    const char* of = is_wall ? "wall" : "grain";
    const auto add = [&](const std::string& what, const std::string& label,
                         const std::vector<HistogramMark>& marks, const std::string& more) {
      const std::string name = fmt::format("{}_contact_{}", of, what);
      const io::HistogramWithErrors& histogram = run.histogram_of(name);
      draft.add_figure(name, draw_histogram(histogram, label, marks), histogram.column.doc + more);
    };
    add("duration", "duration (s)", marks_of_durations(summary, is_wall),
        is_wall ? " t_col: a head-on contact of a grain of the mean mass with a wall."
                : " t_col: a head-on contact between two grains of the mean mass.");
    add("overlap", "largest overlap over the sum of the radii",
        marks_of_overlaps(summary, run.final_state, is_wall), "");
  }
  draft.page().paragraph(fmt::format(
      "How many contacts ended per second after the transient, in four bins to the octave, equally "
      "wide within it, with 68 % error bars. A wall "
      "contact that lasts less than {:.3g} of its own t_col is cut short: the grain has passed "
      "before it was pushed away. Suspect and unphysical: the thresholds of max_overlap_ratio, for "
      "a pair of mean size; steps: that of steps_per_contact. The shortest contacts are grazing "
      "ones, and those pressed together by others.",
      cut_short_below));
}

}  // namespace riesel::app
