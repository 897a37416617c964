#include "app/flow_result.hpp"

#include "engine/histogram_blocks.hpp"
#include "engine/tube_profiles.hpp"

namespace riesel::app {

void write_result(const io::FlowSummary& summary, const FlowMeasurements& measurements,
                  const Tally& tally, std::int64_t first, double interval, RunFiles& files) {
  io::RunFile& record = files.record();
  const Strips& strips = measurements.strips();
  record.write_validity(summary.validity.verdict);
  record.write_profiles(strips,
                        tube_profiles(measurements.profiles(), strips, each_strip(strips), first),
                        summary.transient_end);
  record.write_histograms(histogram_tables(tally, measurements.histograms(), first, interval),
                          summary.transient_end);
  record.flush();
  files.directory().write_summary(io::to_json(summary));
}

}  // namespace riesel::app
