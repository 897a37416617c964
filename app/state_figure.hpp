// The state of a flow, drawn: grains coloured by their axial velocity, wall grains, contacts.
#pragma once

#include "io/run_reader.hpp"
#include "io/svg.hpp"

#include <cstddef>

namespace riesel::app {

struct StateFigure {
  io::Svg svg;
  std::size_t columns;       ///< the tube is cut into so many pieces, drawn side by side
  double length_shown;       ///< m, from y = 0 on
  std::size_t grains_drawn;  ///< each once: those with y < length_shown
};

/// y, along the walls, points down. A long tube is cut into the columns that fill the figure best.
/// Of a tube so large that its grains would not be seen only the part from y = 0 on is shown.
/// Grains of the class "grains", wall grains of "walls", contacts of "contacts".
StateFigure draw_state(const io::FinalState& state);

}  // namespace riesel::app
