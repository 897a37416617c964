#include "app/run_column.hpp"

#include "app/run_problems.hpp"

namespace riesel::app {

namespace {

std::vector<double> gaps_of(const scenarios::ColumnCurve& curve) {
  std::vector<double> gaps;
  for (const double ratio : curve.gap_ratios) gaps.push_back(curve.gap(ratio));
  return gaps;
}

/// Of a drop that was given up, restitution and rebound are not known.
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

void write_drops(io::RunFile& file, const io::ColumnSummary& summary) {
  static const std::vector<PointColumn<io::ColumnPoint>> table = {
      {{"gap_ratio", "1", "Gap between the beads over velocity times t_col at the plate."},
       [](auto& p) { return p.gap_ratio; }},
      {{"gap", "m", "Gap between neighbouring beads before the impact."},
       [](auto& p) { return p.gap; }},
      {{"restitution", "1", "Square root of the energy after over that before."},
       [](auto& p) { return p.restitution; }},
      {{"rebound", "1", "Velocity of the centre of mass after over that before, upwards."},
       [](auto& p) { return p.rebound; }},
      {{"detachment", "1",
        "Of the energy that hard beads would lose, the fraction that these keep."},
       [](auto& p) { return p.detachment; }},
      {{"contacts", "1", "Number of contacts begun."}, [](auto& p) { return p.contacts; }},
      {{"contact_time", "s", "Sum of the durations of the contacts."},
       [](auto& p) { return p.contact_time; }},
      {{"max_overlap", "m", "Largest overlap."}, [](auto& p) { return p.max_overlap; }},
      {{"verdict", "1", "Validity: 0 valid, 1 suspect, 2 unphysical."},
       [](auto& p) { return static_cast<double>(p.verdict); }},
  };
  write_points(file, table, summary.column);
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
      write_drops);
}

}  // namespace riesel::app
