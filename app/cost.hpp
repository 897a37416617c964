// What a run will cost, measured by running a small part of it.
#pragma once

#include "io/settings.hpp"
#include "scenarios/scenario.hpp"

#include <cstddef>
#include <string>

namespace riesel::app {

/// Time steps of a flow; at most as many, if it ends when its mean is precise enough.
double steps_of(const io::Settings& settings, const scenarios::Flow& flow);

/// Particle-steps per second, measured at the start of the flow during at least `seconds`.
double measured_speed(const io::Settings& settings, const scenarios::Flow& flow, int threads,
                      double seconds);

/// Seconds that measuring a row of the series takes, at the start of the flow.
double seconds_per_row(const scenarios::Flow& flow);

/// The cost of a whole curve.
struct CurveCost {
  double steps;
  double seconds;
};

/// Extrapolated from at most `sample` impacts, evenly spread over the curve.
CurveCost measured_cost(const scenarios::ImpactCurve& curve, int threads, std::size_t sample);

/// Likewise, from at most `sample` drops.
CurveCost measured_cost(const scenarios::ColumnCurve& curve, int threads, std::size_t sample);

/// "45 s", "12 min", "3.4 h"
std::string readable_time(double seconds);

}  // namespace riesel::app
