// Figures of curves: means of flows against a setting, as in Fig. 6 of Schaefer and Wolf, and what
// impacts do against their velocity, as in Figs. 3 to 5.
#pragma once

#include "engine/validity.hpp"
#include "io/plot.hpp"
#include "io/summary.hpp"
#include "io/svg.hpp"

#include <span>
#include <string>
#include <vector>

namespace riesel::app {

/// What is told of flows side by side: the mean whose steadiness is judged.
struct FlowQuantity {
  std::string name;  ///< of a file
  std::string heading, unit;
  const io::Measured& (*of)(const io::FlowSummary&);

  /// Of an axis.
  std::string label() const { return heading + " (" + unit + ")"; }
};

/// The mean axial velocity, or the granular temperature, by the series that it is judged by.
const FlowQuantity& judged_quantity(bool by_temperature);

/// The result of a run that is part of a curve.
struct FlowPoint {
  double x = 0.0;     ///< the setting
  io::Measured mean;  ///< of the quantity
  std::string state;  ///< of the flow: "steady", ...
  Validity verdict{};
  std::string directory;  ///< where a click leads, relative to the page
  std::string tip;        ///< what is said when it is pointed at
};

/// Runs that a line joins: their order is that of x.
struct FlowLine {
  std::vector<FlowPoint> points;
  bool leads_back = false;  ///< the backward leg of a continuation
};

/// Several lines if there are several seeds or legs.
struct FlowCurve {
  std::string name;  ///< empty if there is no other
  std::vector<FlowLine> lines;
};

/// `title`: what all curves share; may be empty. Full symbols: steady. Arrows: accelerating. A
/// cross: unphysical. `up` is what leads from the figure to the page: "" or "../".
io::Svg draw_flows(const std::string& title, const std::string& x_label,
                   const FlowQuantity& quantity, std::span<const FlowCurve> curves,
                   const std::string& up);

/// Points of one v_x, their order that of v_y.
struct ImpactLine {
  std::string name;  ///< empty if there is no other
  std::vector<io::CurvePoint> points;
};

/// What is drawn of impacts.
struct ImpactQuantity {
  std::string name;   ///< of a file
  std::string label;  ///< of the axis
  std::string doc;    ///< one sentence
  double io::CurvePoint::*value;
};

/// All that there is to draw; the first two are those of the paper.
const std::vector<ImpactQuantity>& impact_quantities();

/// Full lines, and dashed ones where the verdict is unphysical. Values that the axis cannot show
/// are gaps.
io::Svg draw_impacts(const std::string& title, const ImpactQuantity& quantity,
                     std::span<const ImpactLine> lines);

}  // namespace riesel::app
