// What a run will cost, from a few real steps of it.
#pragma once

#include "io/settings.hpp"
#include "scenarios/scenario.hpp"

#include <cstddef>
#include <string>

namespace riesel::app {

/// Time steps that a flow takes in all; the most, if it ends when it is precise.
double steps_of(const io::Settings& settings, const scenarios::Flow& flow);

/// Particle-steps per second, measured for about so many seconds at the start of the flow.
double measured_speed(const io::Settings& settings, const scenarios::Flow& flow, int threads,
                      double seconds);

/// What measuring a row of the series takes (s), at the start of the flow.
double seconds_per_row(const scenarios::Flow& flow);

struct CurveCost {
  double steps;
  double seconds;
};

/// Of all impacts, from about `sample` of them, evenly spread over the curve.
CurveCost measured_cost(const scenarios::ImpactCurve& curve, int threads, std::size_t sample);

/// Of all drops, likewise.
CurveCost measured_cost(const scenarios::ColumnCurve& curve, int threads, std::size_t sample);

/// "45 s", "12 min", "3.4 h"
std::string readable_time(double seconds);

}  // namespace riesel::app
