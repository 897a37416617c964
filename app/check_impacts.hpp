// What `riesel check` prints about impacts on a wall.
#pragma once

#include "io/settings.hpp"
#include "scenarios/scenario.hpp"

namespace riesel::app {

void check_impacts(const io::Settings& settings, const scenarios::ImpactCurve& curve);

}  // namespace riesel::app
