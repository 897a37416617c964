// The report of an impact scenario: its curves, and where they no longer describe hard grains.
#pragma once

#include "app/curve_record.hpp"
#include "app/report_curves.hpp"
#include "io/summary.hpp"

#include <string>
#include <vector>

namespace riesel::app {

using ImpactRecord = CurveRecord<io::CurveSummary>;

/// Equal records give equal reports, byte by byte.
Report make_report(const ImpactRecord& record);

/// A line for each v_x, with an empty name.
std::vector<ImpactLine> impact_lines(const io::CurveSummary& summary);

/// A sentence that says what the dashed lines of draw_impacts() mean.
std::string what_dashes_mean();

}  // namespace riesel::app
