// The report of a column of beads: what it keeps of its energy, and what hard beads would.
#pragma once

#include "app/report_parts.hpp"
#include "io/run_reader.hpp"
#include "io/summary.hpp"

#include <string>

namespace riesel::app {

/// What a finished run left.
struct ColumnRecord {
  io::ColumnSummary summary;
  io::RunHistory history;
  std::string effective_settings;
};

/// Equal records give equal reports, byte by byte.
Report make_report(const ColumnRecord& record);

}  // namespace riesel::app
