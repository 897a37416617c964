#include "app/flow_result.hpp"

#include "engine/histogram_blocks.hpp"
#include "engine/tube_profiles.hpp"

namespace riesel::app {

void write_result(const io::FlowSummary& summary, const FlowMeasurements& measurements,
                  const Tally& tally, std::int64_t first, double interval, RunFiles& files) {
  io::RunFile& record = files.record();
  const Strips& strips = measurements.strips();
  const io::Window window{.since = summary.transient_end, .state = summary.state};
  record.write_validity(summary.validity.verdict);
  record.write_profiles(
      strips, tube_profiles(measurements.profiles(), strips, each_strip(strips), first), window);
  record.write_histograms(histogram_tables(tally, measurements.histograms(), first, interval),
                          window);
  record.flush();
  files.directory().write_summary(io::to_json(summary));
}

}  // namespace riesel::app
