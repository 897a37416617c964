// The tube cut into strips along its axis: sums over what each of them holds at one moment.
//
// A grain belongs to the strip of its centre, with its mass, its momentum and its kinetic stress;
// its area to the strips that it covers. A contact acts along the line between the two centres, and
// each strip gets the part of the line that lies in it (Irving and Kirkwood, J. Chem. Phys. 18, 817
// (1950)). So the momentum that flying grains and contacts carry from strip to strip is accounted
// for (but for PresentForce, to second order in the time step): the stresses satisfy the balance of
// momentum up to the walls, without free parameters.
//
// All that is kept of a moment are sums over grains and contacts, so that means over time are means
// of these numbers; nonlinear quantities (temperatures) are computed from the means.
#pragma once

#include "engine/contact_law.hpp"
#include "engine/state.hpp"

#include <cstddef>
#include <vector>

namespace riesel {

/// The velocity (m/s) of a frame that moves along with the grains.
struct Frame {
  double vx = 0.0, vy = 0.0;
};

/// The sums over a strip. (u, w) is the velocity of a grain in the frame; z is where it is across
/// the strip, from the middle on in widths of the strip. F is the force on a body of a contact, l
/// the vector from the centre of the other body to its own.
enum class StripSum {
  area,             ///< m^2, covered by grains
  grains,           ///< number of grains with their centre in the strip
  vy,               ///< m/s, sum of v_y
  u2,               ///< (m/s)^2, sum of u^2
  w,                ///< m/s
  w2,               ///< (m/s)^2
  z,                ///< sum of z
  z2,               ///< sum of z^2
  zw,               ///< m/s
  spin,             ///< rad/s
  gyration2,        ///< m^2, sum of I / m, as are the factors of the next two
  gyration2_spin,   ///< m^2/s
  gyration2_spin2,  ///< (m/s)^2
  mass,             ///< kg
  mass_vx2,         ///< J, sum of m v_x^2
  mass_vx_w,        ///< J
  mass_w,           ///< kg m/s
  mass_w2,          ///< J
  mass_z,           ///< kg
  mass_z2,          ///< kg
  mass_zw,          ///< kg m/s
  contact_xx,       ///< J, sum of l_x F_x
  contact_xy,       ///< J, sum of l_x F_y: momentum along y that goes across the tube
  contact_yx,       ///< J, sum of l_y F_x
  contact_yy,       ///< J, sum of l_y F_y
};
inline constexpr std::size_t strip_sums = static_cast<std::size_t>(StripSum::contact_yy) + 1;

/// Strips of equal width between the wall lines, or, with a single wall, up to the width of the
/// box.
struct Strips {
  double width;   ///< m, of one strip
  double length;  ///< m, along the tube: the period
  std::size_t count;
  bool open = false;  ///< there is no wall at large x: what lies beyond the last strip is in none

  /// Strips about a mean diameter wide.
  static Strips of(const State& state);

  double area() const { return width * length; }  ///< m^2
  std::vector<double> middles() const;            ///< m, x of the middle of each
  /// The strip at `x` (m). What lies beyond a wall line belongs to the strip at that wall; `count`
  /// means in none.
  std::size_t at(double x) const;

  /// Index of a sum in the result of sum_over_strips().
  static std::size_t column(std::size_t strip, StripSum sum) {
    return strip * strip_sums + static_cast<std::size_t>(sum);
  }
  std::size_t columns() const { return count * strip_sums; }
};

/// m^2, the part of a disc of this radius (m) that lies at smaller x than a line at distance
/// `line` (m) from its centre, positive towards larger x; to 2e-8 of the square of the radius.
double area_left_of(double line, double radius);

/// The sums over all strips at the step of `state`. The same bits for any order of the slots.
std::vector<double> sum_over_strips(const Strips& strips, const State& state,
                                    const ContactModel& model, const Frame& frame);

}  // namespace riesel
