// What the two impact scenarios share: the grain, the wall, and the curve over the speeds.
#pragma once

#include "scenarios/scenario.hpp"

namespace riesel::scenarios {

/// The settings of the grain, the wall grains and the axial velocities.
io::SettingsTable impact_settings();

/// A curve with its setup, but without points. `wall_spacing` (m) as in ImpactSetup.
ImpactCurve empty_curve(const io::Settings& settings, double wall_spacing);

/// Adds the point (v_x, v_y), in m/s, with one impact from each of the starting places y (m) at
/// height x (m). The time step resolves the collision time or, if shorter, the time in which the
/// grain passes a wall grain: `chord` (m) is the typical path on which they overlap.
void add_point(const io::Settings& settings, ImpactCurve& curve, double v_x, double v_y, double x,
               const std::vector<double>& starts, double chord);

}  // namespace riesel::scenarios
