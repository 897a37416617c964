// A column of rigid beads that falls on a plate: instantaneous collisions, one after the other.
//
// The limit of hard grains for a column of soft ones (engine/bead_column.hpp). It is computed from
// collision to collision, and shares no code with the stepping. As gaps and velocities are equal at
// the start, the result depends on the number of beads and the restitutions only.
//
// Source: Bernu and Mazighi, J. Phys. A 23, 5745 (1990); McNamara and Young, Phys. Fluids A 4, 496
// (1992). Below a restitution of about tan^2(pi/4 (1 - 1/N)) the beads collide infinitely often
// before they could part: the column collapses and keeps no energy.
#pragma once

#include <cstdint>

namespace riesel {

struct RigidColumn {
  double restitution;       ///< square root of the energy after over that before; 0 if it collapses
  double rebound;           ///< velocity of the centre of mass after over that before, upwards
  std::int64_t collisions;  ///< until it is over, or until it was found to collapse
  bool collapsed;
};

/// `beads` of equal mass, which fall with one velocity and equal gaps between them. Throws
/// std::invalid_argument if there are none.
RigidColumn rigid_column(int beads, double restitution_of_beads, double restitution_at_plate);

}  // namespace riesel
