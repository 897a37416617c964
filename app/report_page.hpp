// The report of a flow: what the page says, in which order, beside its figures.
#pragma once

#include "io/run_reader.hpp"
#include "io/summary.hpp"
#include "io/svg.hpp"

#include <string>
#include <vector>

namespace riesel::app {

/// What a finished run left.
struct FlowRecord {
  io::FlowSummary summary;
  io::RunContents run;
  std::string effective_settings;
};

struct ReportFigure {
  std::string name;  ///< of a file, without its ending
  io::Svg svg;
};

struct Report {
  std::string page;  ///< HTML that stands alone
  std::vector<ReportFigure> figures;
};

/// Equal records give equal reports, byte by byte. Throws std::out_of_range if a series is missing.
Report make_report(const FlowRecord& record);

}  // namespace riesel::app
