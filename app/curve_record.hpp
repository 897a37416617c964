// What a finished curve has left on disk, and the report made of it.
#pragma once

#include "app/report_parts.hpp"
#include "io/run_reader.hpp"

#include <string>

namespace riesel::app {

template <class Summary>
struct CurveRecord {
  Summary summary;
  io::RunHistory history;
  std::string effective_settings;
};

/// The parts that differ between kinds of curves are passed in: tell_result(summary, page),
/// show_curves(summary, draft), list_points(summary, page).
template <class Summary, class TellResult, class ShowCurves, class ListPoints>
Report report_of(const CurveRecord<Summary>& record, TellResult tell_result, ShowCurves show_curves,
                 ListPoints list_points) {
  ReportDraft draft("riesel: " + record.summary.run.scenario);
  tell_result(record.summary, draft.page());
  show_curves(record.summary, draft);
  list_points(record.summary, draft.page());
  draft.add_origin(record.summary.run, record.history, record.effective_settings);
  return draft.report();
}

}  // namespace riesel::app
