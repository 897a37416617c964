// What the two impact scenarios share: the grain, the wall, and the curve over the speeds.
#pragma once

#include "scenarios/scenario.hpp"

namespace riesel::scenarios {

/// Rows for the grain and the wall grains.
io::SettingsTable impact_settings();

/// Setup without impacts; `wall_spacing` as in ImpactSetup.
ImpactCurve empty_curve(const io::Settings& settings, double wall_spacing);

/// Adds the point (v_x, v_y) with one impact from each of the starting places y (m) at height x
/// (m). The time step resolves the collision time, and the passage of a wall grain where that is
/// shorter: `chord` (m) is the typical way in the overlap.
void add_point(const io::Settings& settings, ImpactCurve& curve, double v_x, double v_y, double x,
               const std::vector<double>& starts, double chord);

}  // namespace riesel::scenarios
