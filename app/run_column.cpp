#include "app/run_column.hpp"

#include "app/run_problems.hpp"

namespace riesel::app {

namespace {

std::vector<double> gaps_of(const scenarios::ColumnCurve& curve) {
  std::vector<double> gaps;
  for (const double ratio : curve.gap_ratios) gaps.push_back(curve.gap(ratio));
  return gaps;
}

/// What a drop that was given up ended with is not known.
io::ColumnPoint point(const scenarios::ColumnCurve& curve, double gap_ratio,
                      const ColumnResult& r) {
  const double restitution = r.over ? r.restitution : unknown;
  io::ColumnPoint p{.gap_ratio = gap_ratio,
                    .gap = curve.gap(gap_ratio),
                    .restitution = restitution,
                    .rebound = r.over ? r.rebound : unknown,
                    .detachment = detachment(restitution, curve.rigid.restitution),
                    .contacts = r.contacts,
                    .contact_time = r.contact_time,
                    .max_overlap = r.max_overlap};
  p.verdict = judge_drop(p.max_overlap / curve.setup.bead_radius, p.detachment, r.energy_error);
  return p;
}

void write_points(io::RunFile& file, const io::ColumnSummary& summary) {
  std::vector<std::vector<double>> rows;
  for (const io::ColumnPoint& p : summary.column)
    rows.push_back({p.gap_ratio, p.gap, p.restitution, p.rebound, p.detachment, p.contacts,
                    p.contact_time, p.max_overlap, static_cast<double>(p.verdict)});
  file.write_curve(
      {{"gap_ratio", "1", "Gap between the beads over velocity times t_col at the plate."},
       {"gap", "m", "Gap between neighbouring beads before the impact."},
       {"restitution", "1", "Square root of the energy after over that before."},
       {"rebound", "1", "Velocity of the centre of mass after over that before, upwards."},
       {"detachment", "1", "Part of the energy that hard beads lose which these keep."},
       {"contacts", "1", "Number of contacts begun."},
       {"contact_time", "s", "Sum of the durations of the contacts."},
       {"max_overlap", "m", "Largest overlap."},
       {"verdict", "1", "Validity: 0 valid, 1 suspect, 2 unphysical."}},
      rows);
}

}  // namespace

int run_column(const io::Settings& settings, const scenarios::ColumnCurve& curve,
               const RunDirectory& directory, const Arguments& arguments, Verbosity verbosity) {
  const auto summarise = [&](const std::vector<ColumnResult>& results) {
    io::ColumnSummary summary{
        .run = {}, .t_col = curve.setup.collision_time, .rigid = curve.rigid, .column = {}};
    for (std::size_t i = 0; i < results.size(); ++i)
      summary.column.push_back(point(curve, curve.gap_ratios[i], results[i]));
    return summary;
  };
  return run_problems(
      settings, curve.setup.beads, directory, arguments, verbosity,
      [&](int threads) { return drop_all(curve.setup, gaps_of(curve), threads); }, summarise,
      write_points);
}

}  // namespace riesel::app
