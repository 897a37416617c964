// The contacts that are typical of a flow: what is told of it before it runs, and what the verdict
// on its walls as brakes rests on.
//
// Source: Schaefer and Wolf, Phys. Rev. E 51, 6154 (1995), eq. (4) for t_col, and v_crit in the
// text on brake failure; that the chord is the one of an impact: docs/validity-methods.md.
#pragma once

#include "engine/contact_law.hpp"
#include "engine/state.hpp"

namespace riesel {

/// m/s, grains that are slower across the flow are at rest: they sink in nowhere.
inline constexpr double slowest_across = 1e-6;

struct TypicalContacts {
  double t_col_grains;  ///< s, of two grains
  double t_col_walls;   ///< s, of a grain with a wall
  double chord;         ///< m, through a wall grain's edge; infinite where the wall is smooth
  double v_crit;  ///< m/s along the wall, above which a contact with it is cut short; likewise
};

/// Of grains of the mean mass and size that meet each other and the first wall head-on with
/// `across` (m/s), and at least slowest_across. Throws std::domain_error if they do not rebound.
TypicalContacts typical_contacts(const State& state, const NormalLaw& normal, double across);

}  // namespace riesel
