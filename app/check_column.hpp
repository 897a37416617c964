// What `riesel check` prints about a column of beads.
#pragma once

#include "io/settings.hpp"
#include "scenarios/scenario.hpp"

namespace riesel::app {

void check_column(const io::Settings& settings, const scenarios::ColumnCurve& curve);

}  // namespace riesel::app
