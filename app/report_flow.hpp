// The report of a flow: what the page says, in which order, beside its figures.
#pragma once

#include "app/report_parts.hpp"
#include "io/run_reader.hpp"
#include "io/summary.hpp"

#include <string>

namespace riesel::app {

/// What a finished flow has left on disk.
struct FlowRecord {
  io::FlowSummary summary;
  io::RunContents run;
  std::string effective_settings;
};

/// Equal records give equal reports, byte by byte. Throws std::out_of_range if a series is missing.
Report make_report(const FlowRecord& record);

}  // namespace riesel::app
