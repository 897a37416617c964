// The state of a flow, drawn: grains coloured by their axial velocity, wall grains, contacts as
// lines as thick as their forces are large.
#pragma once

#include "io/run_reader.hpp"
#include "io/svg.hpp"

#include <cstddef>

namespace riesel::app {

struct StateFigure {
  io::Svg svg;
  std::size_t columns;       ///< pieces into which the tube is cut, drawn side by side
  double length_shown;       ///< m, from y = 0 on
  std::size_t grains_drawn;  ///< each once: those with y < length_shown
  double largest_force;      ///< N, of the contact with the thickest line; 0 if it is not known
};

/// y, along the walls, points down. A long tube is cut into the columns that fill the figure best;
/// if its grains would still be too small to see, only the part next to y = 0 is shown. The SVG
/// classes are "grains", "walls" (wall grains) and "contacts".
StateFigure draw_state(const io::FinalState& state);

}  // namespace riesel::app
