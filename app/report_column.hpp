// The report of a column of beads: the energy that it keeps, and that hard beads would keep.
#pragma once

#include "app/curve_record.hpp"
#include "io/summary.hpp"

namespace riesel::app {

using ColumnRecord = CurveRecord<io::ColumnSummary>;

/// Equal records give equal reports, byte by byte.
Report make_report(const ColumnRecord& record);

}  // namespace riesel::app
