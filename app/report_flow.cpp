#include "app/report_flow.hpp"

#include "app/plain_words.hpp"
#include "app/report_contacts.hpp"
#include "app/report_curves.hpp"
#include "app/report_figures.hpp"
#include "app/state_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace riesel::app {

namespace {

std::string what_validity_means(Validity validity) {
  if (validity == Validity::valid)
    return "Valid: nothing was found that would make the result an artefact of soft contacts.";
  if (validity == Validity::suspect)
    return "Suspect: something was found that may change the result, or evidence is missing:";
  return "Unphysical: the result is an artefact of soft contacts and no property of hard grains:";
}

class FlowReport {
public:
  explicit FlowReport(const FlowRecord& record)
      : record_(&record), draft_("riesel: " + record.summary.run.scenario) {}

  Report make() && {
    tell_result();
    show_state();
    show_series();
    show_profiles();
    show_energy();
    show_walls();
    show_contacts(record_->run, summary(), draft_);
    draft_.add_origin(summary().run, record_->run.history, record_->effective_settings);
    return draft_.report();
  }

private:
  const io::FlowSummary& summary() const { return record_->summary; }
  io::HtmlPage& page() { return draft_.page(); }

  void tell_result() {
    const auto& s = summary();
    page().paragraph(fmt::format(
        "{}, {:.6g} s in {}. The run ended ({}): {}.", so_many(s.run.grains, "grain"), s.time,
        so_many(s.run.steps, "step"), name(s.ended_by), explanation_of_end(s.ended_by)));
    const bool is_steady = s.state == SteadyVerdict::steady;
    const bool by_temperature = s.judged_by == io::JudgedBy::granular_temperature;
    page().paragraph(
        fmt::format(
            "{}. {}. State, by {} independent samples: {}: {}.{}",
            told(judged_quantity(by_temperature), fmt::format(" after {:.3g} s", s.transient_end)),
            told(judged_quantity(!by_temperature), ""), number(s.independent_samples, "{:.3g}"),
            name(s.state), explanation_of_state(s),
            is_steady ? "" : " The mean is not to be used as a property of the flow."),
        is_steady ? "good" : "doubtful");
    tell_validity();
  }

  /// "Mean axial velocity 1.534 ± 0.050 m/s after 0.25 s (68 % error bar)"; `when` may be empty.
  std::string told(const FlowQuantity& quantity, const std::string& when) const {
    const io::Measured& mean = quantity.of(summary());
    return fmt::format("{} {}{}{}", quantity.heading, with_error(mean, quantity.unit), when,
                       std::isnan(mean.error) ? "" : " (68 % error bar)");
  }

  void tell_validity() {
    const ValidityVerdict& v = summary().validity.verdict;
    page().paragraph(what_validity_means(v.verdict), class_of(v.verdict));
    std::vector<std::string> reasons;
    for (const Finding& f : v.findings)
      if (f.verdict != Validity::valid)
        reasons.push_back(fmt::format("{}: {}", name(f.verdict), explanation(f)));
    // The finding limits_exceeded only counts them.
    const auto& warnings = summary().validity.warnings;
    reasons.insert(reasons.end(), warnings.begin(), warnings.end());
    if (!reasons.empty()) page().list(reasons);
    io::HtmlRows rows = {{"finding", "value", "suspect", "unphysical", "says"}};
    for (const Finding& f : v.findings) {
      const auto threshold = [&](double value) {
        return std::isfinite(value)
                   ? fmt::format("{} {:.3g}", f.low_is_bad ? "below" : "above", value)
                   : std::string("no threshold");
      };
      rows.push_back({std::string(f.name), number(f.value, "{:.3g}"), threshold(f.suspect),
                      threshold(f.unphysical), std::string(name(f.verdict))});
    }
    page().table(rows);
  }

  void show_state() {
    const io::FinalState& state = record_->run.final_state;
    const StateFigure figure = draw_state(state);
    std::string shown = fmt::format("All {} grains", figure.grains_drawn);
    if (figure.grains_drawn < state.grains.size())
      shown = fmt::format(
          "Only a part of the flow, {:.4g} mm of {:.4g} mm from y = 0 on: {} of {} grains",
          1e3 * figure.length_shown, 1e3 * state.box.length, figure.grains_drawn,
          state.grains.size());
    const std::string cut =
        figure.columns == 1
            ? ""
            : fmt::format(" It is cut into {} columns: each goes on at the top of the next one.",
                          figure.columns);
    page().heading("The state at the end");
    draft_.add_figure(
        "state", figure.svg,
        fmt::format("{} at t = {:.6g} s, coloured by their axial velocity, {}. "
                    "The box is {:.4g} mm wide and {:.4g} mm long. Grey: wall grains. Red lines: "
                    "contacts, from centre to centre{}.{} The slowest "
                    "and the fastest hundredth of all grains may lie beyond the ends of the "
                    "colour bar and have their colours.",
                    shown, state.time, what_axes_mean(), 1e3 * state.box.width,
                    1e3 * state.box.length, what_thickness_means(figure), cut));
  }

  static std::string what_thickness_means(const StateFigure& figure) {
    if (figure.largest_force == 0.0) return "";
    return fmt::format(
        ", as thick as their forces are large, up to {:.4g} N; those below a twelfth are alike",
        figure.largest_force);
  }

  std::string what_axes_mean() const {
    if (summary().braking_force.right) return "x to the right and y down";
    return "x (the height above the bottom) to the right and y (down the slope) down";
  }

  /// Marks means only in series of which summary.json has one.
  void show_series() {
    const auto& s = summary();
    const auto mean = [](const io::Measured& m) {
      return std::isnan(m.value) ? std::nullopt : std::optional(m);
    };
    const std::vector<std::pair<std::string, std::optional<io::Measured>>> shown = {
        {"mean_vy", mean(s.mean_axial_velocity)},
        {"granular_temperature", mean(s.fluctuations.granular_temperature)},
        {"contacts", std::nullopt},
        {"max_overlap", std::nullopt}};
    page().heading("Series");
    const io::Series& time = record_->run.series_of("time");
    for (const auto& [name, of_mean] : shown) {
      const io::Series& series = record_->run.series_of(name);
      std::string caption = series.column.doc;
      if (of_mean) caption += " Orange: the mean after the transient";
      if (of_mean)
        caption +=
            std::isnan(of_mean->error) ? "; its error is not known." : ", and its error as a band.";
      draft_.add_figure(name, draw_series(time, series, {s.transient_end, of_mean}), caption);
    }
    page().paragraph(fmt::format(
        "Grey: the transient, up to t = {:.4g} s, which is left out of all means. Where there are "
        "more rows than pixels, each column shows its first, lowest, highest and last value.",
        s.transient_end));
  }

  void show_profiles() {
    page().heading("Across the flow");
    const auto add = [&](const std::string& file, const std::string& label,
                         const std::vector<std::string>& names) {
      draft_.add_figure(file, draw_profiles(record_->run.profiles, names, label),
                        fmt::format("{} in strips along the flow, means after the transient with "
                                    "68 % error bars.",
                                    label));
    };
    add("area_fraction", "Area fraction", {"area_fraction"});
    add("velocity", "Mean axial velocity (m/s)", {"mean_axial_velocity"});
    add("temperature", "Granular temperature (m^2/s^2)", {"temperature_x", "temperature_y"});
    if (record_->run.profiles.have_spins()) {
      add("spin", "Mean spin (rad/s)", {"mean_spin"});
      add("rotational_temperature", "Rotational temperature (m^2/s^2)", {"rotational_temperature"});
    }
    add("stress", "Stress (N/m)", {"stress_xx", "stress_yy", "stress_xy"});
    page().paragraph(fmt::format(
        "Stresses are positive in compression{}. The error bars do not account for drift: if the "
        "flow is not steady, these are merely means over the observed time.",
        has_weight(summary().braking_force)
            ? fmt::format("; in a steady state stress_xy carries the weight of the grains to {}",
                          brake_of(summary().braking_force))
            : ""));
  }

  void show_energy() {
    page().heading("Energy");
    const auto parts = parts_of(summary().energy);
    const double turned_over = summary().energy.turned_over();
    io::HtmlRows rows = {{"part", "J", "of what was turned over"}};
    for (const EnergyPart& part : parts)
      rows.push_back({part.name, number(part.value),
                      turned_over > 0.0 ? fmt::format("{:.3g} %", 100.0 * part.value / turned_over)
                                        : std::string("not defined")});
    page().table(rows);
    if (std::ranges::all_of(parts, [](const EnergyPart& p) { return std::isfinite(p.value); }))
      draft_.add_figure(
          "energy", draw_energy(parts),
          "Blue: energy that was there at the start or came in since; negative values left the "
          "system. Orange: where it is. The residual is what is missing in the balance: the error "
          "of the calculation. 'Turned over' is the initial energy plus the absolute values of the "
          "work.");
  }

  void show_walls() {
    const auto& b = summary().balance;
    const auto& v = summary().wall_visits;
    page().heading("Walls");
    const auto& force = summary().braking_force;
    io::HtmlRows rows = {
        {"after the transient", "value"},
        {"wall contacts per grain, n_dot", with_error(b.n_dot, "1/s")},
        {"axial momentum lost per wall contact, over the mean mass", with_error(b.dv_y, "m/s")},
        {"their product, equal to gravity in a steady state", with_error(b.n_dot_dv_y, "m/s^2")},
        {"gravity", number(b.gravity) + " m/s^2"},
        {"contacts with other grains per grain", with_error(summary().grain_contact_rate, "1/s")},
        {"braking force of the " + left_wall_of(force), with_error(force.left, "N")}};
    if (force.right)
      rows.push_back(
          {fmt::format("braking force of the {}", right_wall), with_error(*force.right, "N")});
    const auto& pressure = summary().wall_pressure;
    rows.push_back({"pressure on the " + left_wall_of(force), with_error(pressure.left, "N/m")});
    if (pressure.right)
      rows.push_back(
          {fmt::format("pressure on the {}", right_wall), with_error(*pressure.right, "N/m")});
    rows.insert(
        rows.end(),
        {{fmt::format("weight of all grains along {0}, carried by {0} in a steady state",
                      brake_of(force)),
          number(force.weight) + " N"},
         {"visits to a wall", number(v.visits, "{:.0f}")},
         {"contacts per visit", with_error(v.contacts, "")},
         {"axial velocity lost per visit", with_error(v.dv_y, "m/s")},
         {"velocity above which a wall contact is cut short, v_crit",
          std::isnan(summary().validity.v_crit) ? "none"
                                                : number(summary().validity.v_crit) + " m/s"}});
    page().table(rows);
    show_braking(record_->run, summary(), draft_);
    draft_.add_figure("visits", draw_visits(v.of_contacts),
                      "Contacts per visit to a wall, of all visits that have ended since the "
                      "start. Many contacts with short passages are the brake failure of the "
                      "paper; see passages_per_wall_visit above.");
  }

  const FlowRecord* record_;
  ReportDraft draft_;
};

}  // namespace

Report make_report(const FlowRecord& record) { return FlowReport(record).make(); }

}  // namespace riesel::app
