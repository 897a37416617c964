// The report of an impact scenario: its curves, and where they are no property of hard grains.
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

/// A line for each v_x, without names.
std::vector<ImpactLine> impact_lines(const io::CurveSummary& summary);

/// What dashed lines of draw_impacts() mean, in words.
std::string what_dashes_mean();

}  // namespace riesel::app
