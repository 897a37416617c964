// What contacts do, in a flow's report: histograms of their durations and overlaps, with the marks
// by which they are judged, and the forces by which the walls brake.
#pragma once

#include "app/report_parts.hpp"
#include "io/run_reader.hpp"
#include "io/summary.hpp"

#include <string>

namespace riesel::app {

/// What a page calls the walls: one that has no other above it is the bottom of a chute.
std::string left_wall_of(const io::FlowSummary::BrakingForce& force);
inline constexpr auto right_wall = "right wall";

/// How the walls brake, in time, as a part of a flow's report.
void show_braking(const io::RunContents& run, const io::FlowSummary& summary, ReportDraft& draft);

/// The histograms of a flow as a part of its report.
void show_contacts(const io::RunContents& run, const io::FlowSummary& summary, ReportDraft& draft);

}  // namespace riesel::app
