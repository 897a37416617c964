// Walls as brakes: how much of the braking is done by contacts that were cut short.
//
// A grain that grazes a wall grain leaves it either because the contact has pushed it away, after
// t_col, or because the surface has curved away from its path. In the second case the contact was
// cut short: the grain has passed through the edge of the wall grain, deeper for softer contacts,
// and what it lost depends on k_N and is no property of hard grains. Schaefer and Wolf, Phys. Rev.
// E 51, 6154 (1995), call this brake failure.
#pragma once

#include "engine/contact.hpp"
#include "engine/contact_law.hpp"
#include "engine/exact_sum.hpp"

#include <cstdint>

namespace riesel {

/// A contact is cut short if it lasts less than this part of t_col. For an elastic spring and a
/// straight path along a round surface
///     duration = (2 t_col / pi) arctan(pi t_trav / (2 t_col)),   t_trav = chord / speed,
/// which is (2/pi) arctan(pi/2) = 0.639 of t_col where passing the chord takes as long as t_col.
inline constexpr double cut_short_below = 0.6390;

/// Whether an ended contact of a grain of mass `mass` (kg) with a wall was cut short.
bool is_cut_short(const Contact& contact, const ContactModel& model, double mass);

/// s, for how long an ended contact of a grain of mass `mass` (kg) with a wall pulled: F_N < 0. An
/// estimate, for an overlap that is a parabola with the duration and the largest overlap of the
/// contact: too low where damping makes it skew, by a tenth at e_N = 0.7 and a quarter at 0.36.
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

  /// `mass` (kg) is that of the grain. At a `smooth` wall no contact is cut short: it has no edge
  /// to pass, and one that ends early was ended by another grain.
  void add(const Contact& contact, const ContactModel& model, double mass, bool smooth);
};

}  // namespace riesel
