// From the points of a sweep to curves: which setting is the axis, and which runs belong together.
#pragma once

#include "app/report_curves.hpp"
#include "app/report_sweep.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace riesel::app {

/// The index of the varied setting that figures have as their axis: the one along which runs
/// continue each other, or else the one with the most numeric values, the first if several have as
/// many. Never the seed. Nothing if no setting has two values.
std::optional<std::size_t> axis_of(const io::Manifest& manifest);

struct FlowPanel {
  std::string title;
  std::vector<FlowCurve> curves;
};

/// The flows of a sweep: a curve for each combination of all settings but the axis and the seed,
/// with a line for each seed and leg (forward or backward along a continuation). Settings that
/// follow from the axis do not separate curves.
std::vector<FlowPanel> flow_panels(const SweepRecord& record, std::size_t axis,
                                   const FlowQuantity& quantity);

struct ImpactPanel {
  std::string title;
  std::vector<ImpactLine> lines;
};

/// The impacts of a sweep: a line for each point and v_x.
std::vector<ImpactPanel> impact_panels(const SweepRecord& record);

/// What distinguishes a point from the others, in one line.
std::string description_of(const io::Manifest& manifest, const io::ManifestPoint& point);

}  // namespace riesel::app
