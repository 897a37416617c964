// Figures of curves: means of flows against a setting, as in Fig. 6 of Schaefer and Wolf, and
// results of impacts against their velocity, as in Figs. 3 to 5.
#pragma once

#include "engine/steady_state.hpp"
#include "engine/validity.hpp"
#include "io/plot.hpp"
#include "io/summary.hpp"
#include "io/svg.hpp"

#include <span>
#include <string>
#include <vector>

namespace riesel::app {

/// The quantity by which flows are compared: the mean whose steadiness is judged.
struct FlowQuantity {
  std::string name;  ///< of a file
  std::string heading, unit;
  const io::Measured& (*of)(const io::FlowSummary&);

  /// The label of an axis.
  std::string label() const { return heading + " (" + unit + ")"; }
};

/// The granular temperature for flows that are judged by it, otherwise the mean axial velocity.
const FlowQuantity& judged_quantity(bool by_temperature);

/// The result of a run that is part of a curve.
struct FlowPoint {
  double x = 0.0;         ///< value of the setting
  io::Measured mean;      ///< of the quantity
  SteadyVerdict state{};  ///< of the flow
  Validity verdict{};
  std::string directory;  ///< target of its link, relative to the page
  std::string tip;        ///< text shown when the mouse is over it
};

/// Runs that a line joins, in the order of x.
struct FlowLine {
  std::vector<FlowPoint> points;
  bool leads_back = false;  ///< the backward leg of a continuation
};

/// Several lines if there are several seeds or legs.
struct FlowCurve {
  std::string name;  ///< "" if it is the only one
  std::vector<FlowLine> lines;
};

/// `title`: what all curves share; may be empty. Full symbols: steady. Arrows: accelerating.
/// Crosses: unphysical. `up`: prefix of links, the way from the figure to the page: "" or "../".
io::Svg draw_flows(const std::string& title, const std::string& x_label,
                   const FlowQuantity& quantity, std::span<const FlowCurve> curves,
                   const std::string& up);

/// Points of one v_x, in the order of v_y.
struct ImpactLine {
  std::string name;  ///< "" if it is the only one
  std::vector<io::CurvePoint> points;
};

/// A quantity of impacts that is drawn.
struct ImpactQuantity {
  std::string name;   ///< of a file
  std::string label;  ///< of the axis
  std::string doc;    ///< one sentence
  double io::CurvePoint::*value;
};

/// All quantities; the first two are those of the paper.
const std::vector<ImpactQuantity>& impact_quantities();

/// Lines are dashed where the verdict is unphysical. Values that the axis cannot show leave gaps.
io::Svg draw_impacts(const std::string& title, const ImpactQuantity& quantity,
                     std::span<const ImpactLine> lines);

}  // namespace riesel::app
