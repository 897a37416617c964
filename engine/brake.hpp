// Walls as brakes: how much of the braking is done by contacts that were cut short.
//
// A grain that grazes a wall grain leaves it either because the contact has pushed it away, after
// t_col, or because the surface has curved away from its path. In the second case the contact was a
// passage: the grain has gone through the edge of the wall grain, the softer the contact the
// deeper, and what it lost is set by k_N and no property of hard grains. Schaefer and Wolf call it
// brake failure.
#pragma once

#include "engine/contact.hpp"
#include "engine/contact_law.hpp"
#include "engine/exact_sum.hpp"

#include <cstdint>

namespace riesel {

/// A contact is cut short if it lasts less than this part of t_col. For an elastic spring and a
/// straight path along a round surface
///     duration = (2 t_col / pi) arctan(pi t_trav / (2 t_col)),   t_trav = chord / speed,
/// so that this is where the passage of the chord takes as long as t_col: (2/pi) arctan(pi/2).
inline constexpr double cut_short_below = 0.6390;

/// Whether the passage of a grain of mass `mass` (kg) took less than t_col. Contact and entry
/// velocity as they were at the end.
bool is_cut_short(const Contact& contact, const NormalLaw& normal, double mass);

/// s, for how long an ended contact of a grain of `mass` (kg) pulled: F_N < 0. Worked out, not
/// watched: for a parabola of the overlap with the contact's duration and largest overlap.
double pulling_time(const Contact& contact, const ContactModel& model, double mass);

/// Sums over ended contacts with walls. "Braking" is the impulse against +y of those contacts that
/// took axial momentum from the grain.
struct BrakeTally {
  std::int64_t contacts = 0;
  std::int64_t cut_short = 0;
  ExactSum braking;                  ///< kg m/s
  ExactSum braking_cut_short;        ///< kg m/s
  ExactSum friction_loss;            ///< J
  ExactSum friction_loss_cut_short;  ///< J
  ExactSum entry_slip;               ///< m/s, |slip| at the beginning
  ExactSum duration;                 ///< s
  ExactSum pulling;                  ///< s

  /// `mass` (kg) is that of the grain.
  void add(const Contact& contact, const ContactModel& model, double mass);
};

}  // namespace riesel
