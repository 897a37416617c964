#include "app/print_summary.hpp"

#include "app/plain_words.hpp"
#include "app/terminal.hpp"
#include "io/run_file.hpp"

#include <fmt/core.h>

#include <cmath>
#include <string>

namespace riesel::app {

namespace {

/// In ASCII, for the screen.
std::string text_of(const io::Measured& m, const char* unit, int digits = 4, int error_digits = 2) {
  return with_error(m, unit, "+-", digits, error_digits);
}

void print_balance(const io::FlowSummary::Balance& b) {
  if (std::isnan(b.n_dot.value)) {
    fmt::print("  {:<22}not known, gravity {:.4g} m/s^2\n", "wall collisions", b.gravity);
    return;
  }
  const bool any_new = b.n_dot.value > 0.0;
  if (!any_new && b.n_dot_dv_y.value == 0.0) {
    fmt::print("  {:<22}none after the transient, gravity {:.4g} m/s^2\n", "wall collisions",
               b.gravity);
    return;
  }
  const std::string factors =
      any_new ? fmt::format("{:.4g} 1/s per grain x {:.4g} m/s", b.n_dot.value, b.dv_y.value)
              : "no new ones; lasting contacts";
  fmt::print("  {:<22}{} = {}, gravity {:.4g} m/s^2\n", "wall collisions", factors,
             text_of(b.n_dot_dv_y, "m/s^2"), b.gravity);
}

void print_braking(const io::FlowSummary::BrakingForce& f) {
  const std::string right = f.right ? fmt::format(", right {}", text_of(*f.right, "N")) : "";
  fmt::print("  {:<22}left {}{}, weight {:.4g} N\n", "braking by the walls", text_of(f.left, "N"),
             right, f.weight);
}

void print_visits(const io::FlowSummary::WallVisits& v) {
  if (v.visits == 0.0) {
    fmt::print("  {:<22}none after the transient\n", "visit to a wall");
    return;
  }
  fmt::print("  {:<22}{}, {} lost ({:.0f} visits)\n", "visit to a wall",
             text_of(v.contacts, "contacts", 3, 1), text_of(v.dv_y, "m/s", 3, 1), v.visits);
}

/// Whether the mean is that of a steady flow, and how to go on if the run was too short.
void print_state(const io::FlowSummary& s, const std::filesystem::path& directory) {
  fmt::print(
      "  {:<22}{}: {}\n", "state",
      coloured(name(s.state), s.state == SteadyVerdict::steady ? Colour::green : Colour::yellow),
      explanation_of_state(s));
  if (asks_for_more(s))
    fmt::print("  {:<22}{} --set {}='{:.2g} s'\n", "go on by", call_of("resume", directory),
               s.ended_by == io::EndedBy::duration ? "run.duration" : "run.until.at_most",
               sufficient_duration(s));
}

Colour colour_of(Validity verdict) {
  if (verdict == Validity::valid) return Colour::green;
  return verdict == Validity::suspect ? Colour::yellow : Colour::red;
}

/// The verdict, and the findings that are the reasons for it.
void print_validity(const ValidityVerdict& v) {
  fmt::print("  {:<22}{}\n", "validity", coloured(name(v.verdict), colour_of(v.verdict)));
  for (const Finding& f : v.findings) {
    if (f.verdict == Validity::valid) continue;
    fmt::print("  {:<22}{}\n", name(f.verdict), explanation(f));
  }
}

void print_common(const io::RunSummary& run, const std::filesystem::path& directory) {
  fmt::print("  {:<22}{:.1f} million particle-steps/s on {} ({:.1f} s)\n", "speed",
             run.particle_steps_per_second / 1e6, so_many(run.threads, "thread"), run.wall_seconds);
  fmt::print("  {:<22}{:016x}\n", "state hash", run.state_hash);
  fmt::print("  {:<22}{}, {}, {}\n", "files", (directory / io::summary_name).string(),
             io::run_file_name, io::effective_settings_name);
}

}  // namespace

void print_summary(const io::FlowSummary& s, const std::filesystem::path& directory) {
  fmt::print("{}: {}, {:.6g} s in {}\n", s.run.scenario, so_many(s.run.grains, "grain"), s.time,
             so_many(s.run.steps, "step"));
  fmt::print("  {:<22}{} (after {:.3g} s)\n", "mean axial velocity",
             text_of(s.mean_axial_velocity, "m/s", 5), s.transient_end);
  print_state(s, directory);
  if (s.ended_by != io::EndedBy::duration)
    fmt::print("  {:<22}{}\n", "ended", explanation_of_end(s.ended_by));
  fmt::print("  {:<22}{}\n", "granular temperature",
             text_of(s.fluctuations.granular_temperature, "m^2/s^2"));
  print_balance(s.balance);
  print_braking(s.braking_force);
  print_visits(s.wall_visits);
  if (const double turned_over = s.energy.turned_over(); turned_over > 0.0)
    fmt::print("  {:<22}{:.2g} of the energy turned over\n", "energy residual",
               s.energy.residual / turned_over);
  print_validity(s.validity.verdict);
  print_common(s.run, directory);
}

void print_summary(const io::CurveSummary& s, const std::filesystem::path& directory) {
  const auto [passed, stuck] = left_out_of(s);
  fmt::print("{}: {}\n", s.run.scenario, so_many(std::ssize(s.curve), "point"));
  if (passed > 0)
    fmt::print("  {:<22}{}, left out of the means\n", "through the wall",
               so_many(passed, "impact"));
  if (stuck > 0)
    fmt::print("  {:<22}{}, left out of the means\n", "stuck at the wall",
               so_many(stuck, "impact"));
  fmt::print("  {:<22}{}\n", "validity", count_of_verdicts(s));
  for (const CurveReason& reason : reasons_of(s)) {
    fmt::print("  {:<22}{}\n", name(reason.verdict), reason.text);
    for (const std::string& place : reason.places) fmt::print("  {:<22}  {}\n", "", place);
  }
  print_common(s.run, directory);
}

void print_summary(const io::ColumnSummary& s, const std::filesystem::path& directory) {
  fmt::print("{}: {}, {}\n", s.run.scenario, so_many(s.run.grains, "bead"),
             so_many(std::ssize(s.column), "drop"));
  fmt::print("  {:<22}{}\n", "hard beads", description_of(s.rigid));
  for (const io::ColumnPoint* p : {&s.column.front(), &s.column.back()})
    fmt::print("  {:<22}effective restitution {} at gaps of {:.3g} v t_col\n", "these beads",
               std::isnan(p->restitution) ? "not known" : fmt::format("{:.4g}", p->restitution),
               p->gap_ratio);
  fmt::print("  {:<22}{}\n", "validity", count_of_verdicts(s));
  fmt::print("  {:<22}{}\n", "contacts", where_hard(s));
  print_common(s.run, directory);
}

}  // namespace riesel::app
