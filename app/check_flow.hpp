// What `riesel check` prints about a flow: grains and walls, contacts, brake failure, cost.
#pragma once

#include "io/settings.hpp"
#include "scenarios/scenario.hpp"

namespace riesel::app {

void check_flow(const io::Settings& settings, const scenarios::Flow& flow);

}  // namespace riesel::app
