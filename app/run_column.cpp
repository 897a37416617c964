#include "app/run_column.hpp"

#include "app/cost.hpp"
#include "app/exit_status.hpp"
#include "app/print_summary.hpp"
#include "io/durable_file.hpp"
#include "io/run_file.hpp"
#include "io/summary.hpp"

#include <chrono>

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
  p.verdict = judge_drop(p.max_overlap / curve.setup.bead_radius, p.detachment);
  return p;
}

void write_points(io::RunFile& file, const std::vector<io::ColumnPoint>& column) {
  std::vector<std::vector<double>> rows;
  for (const io::ColumnPoint& p : column)
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
  using Clock = std::chrono::steady_clock;
  const int threads = threads_for_curve(settings);
  const auto provenance = io::collect_provenance({.arguments = arguments,
                                                  .seed = settings.integer("seed"),
                                                  .threads = threads,
                                                  .source = settings.source_text(),
                                                  .settings = settings.effective_yaml()});
  const auto start = Clock::now();
  const std::vector<ColumnResult> results = drop_all(curve.setup, gaps_of(curve), threads);
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();

  io::ColumnSummary summary{
      .run = {}, .t_col = curve.setup.collision_time, .rigid = curve.rigid, .column = {}};
  std::int64_t steps = 0;
  for (std::size_t i = 0; i < results.size(); ++i) {
    summary.column.push_back(point(curve, curve.gap_ratios[i], results[i]));
    steps += results[i].steps;
  }
  summary.run = {.scenario = settings.scenario(),
                 .grains = curve.setup.beads,
                 .steps = steps,
                 .state_hash = hash_of(results),
                 .wall_seconds = seconds,
                 .particle_steps_per_second =
                     curve.setup.beads * static_cast<double>(steps) / seconds,
                 .threads = threads};
  // Not before: a curve cannot be resumed, and what is interrupted may be called again.
  auto file = io::RunFile::create(directory.file(io::run_file_name), provenance, {});
  write_points(file, summary.column);
  file.flush();
  io::write_durably(directory.file(io::summary_name), io::to_json(summary));
  if (verbosity != Verbosity::quiet) print_summary(summary, directory.path());
  return exit_done;
}

}  // namespace riesel::app
