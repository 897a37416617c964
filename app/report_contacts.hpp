// What contacts do, in a flow's report: histograms of their durations and overlaps, with the
// thresholds by which they are judged, and the forces with which the walls brake.
#pragma once

#include "app/report_parts.hpp"
#include "io/run_reader.hpp"
#include "io/summary.hpp"

#include <string>
#include <string_view>

namespace riesel::app {

/// The names of the walls on the page: a left wall without a right one is the bottom of a chute.
std::string left_wall_of(const io::FlowSummary::BrakingForce& force);
inline constexpr auto right_wall = "right wall";
/// What brakes the grains: "the walls", or "the bottom".
std::string_view brake_of(const io::FlowSummary::BrakingForce& force);

/// Whether gravity pulls along the walls.
bool has_weight(const io::FlowSummary::BrakingForce& force);

/// Adds the braking force of the walls over time to a flow's report.
void show_braking(const io::RunContents& run, const io::FlowSummary& summary, ReportDraft& draft);

/// Adds the histograms of contacts to a flow's report.
void show_contacts(const io::RunContents& run, const io::FlowSummary& summary, ReportDraft& draft);

}  // namespace riesel::app
