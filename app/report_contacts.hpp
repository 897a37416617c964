// What contacts do, in a flow's report: histograms of their durations and overlaps, with the marks
// by which they are judged, and the forces by which the walls brake.
#pragma once

#include "app/report_parts.hpp"
#include "io/run_reader.hpp"
#include "io/summary.hpp"
#include "io/svg.hpp"

#include <string>
#include <vector>

namespace riesel::app {

/// A value on the axis of a histogram that means something.
struct HistogramMark {
  double at = 0.0;  ///< in the unit of the axis; not a number: not known, and not drawn
  std::string label;
};

/// Bars with errors on logarithmic axes; `marks` ascend.
io::Svg draw_histogram(const io::HistogramWithErrors& histogram, const std::string& x_label,
                       const std::vector<HistogramMark>& marks);

/// Mean forces of the left and the right wall (N, positive where they brake) over parts of the
/// time, and half of the weight.
io::Svg draw_braking(const io::RunContents& run, const io::FlowSummary& summary);

/// The histograms of a flow as a part of its report.
void show_contacts(const io::RunContents& run, const io::FlowSummary& summary, ReportDraft& draft);

}  // namespace riesel::app
