// The contacts that are typical of a flow: for the figures that are shown before a run, and for the
// verdict on its walls as brakes.
//
// Source: Schaefer and Wolf, Phys. Rev. E 51, 6154 (1995), eq. (4) for t_col, and v_crit in the
// text on brake failure; that the chord is the one of an impact: docs/validity-methods.md.
#pragma once

#include "engine/contact_law.hpp"
#include "engine/state.hpp"

namespace riesel {

/// m/s, least speed across the flow that is assumed: below it contacts would have no depth.
inline constexpr double slowest_across = 1e-6;

struct TypicalContacts {
  double t_col_grains;  ///< s, of two grains
  double t_col_walls;   ///< s, of a grain with a wall
  double chord;         ///< m, through the edge of a wall grain; infinite for a smooth wall
  double v_crit;  ///< m/s along the wall, above which contacts are cut short; infinite likewise
};

/// For grains of the mean mass and size that meet each other and the first wall head-on with the
/// speed `across` (m/s), or with slowest_across if that is larger. The state must have a wall.
/// Throws std::domain_error if the grains do not rebound.
TypicalContacts typical_contacts(const State& state, const ContactModel& model, double across);

}  // namespace riesel
