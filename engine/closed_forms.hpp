// What is known of a contact without simulating it. SI units.
//
// Source: Schaefer and Wolf, Phys. Rev. E 51, 6154 (1995), eqs. (4), (5) and the text around them;
// for contacts that may not pull Schwager and Poeschel, Granular Matter 9, 465 (2007); for the
// general elastic law the quadrature of the energy integral, e.g. Landau and Lifshitz,
// Theory of Elasticity, par. 9.
#pragma once

#include "engine/contact_law.hpp"

#include <optional>

namespace riesel {

/// A linear contact of two bodies: k_N in N/m, gamma_N in 1/s, reduced mass in kg.
struct LinearContact {
  double k_n, gamma_n, reduced_mass;
  Attraction attraction = Attraction::keep;

  /// Whether the damping is below critical. Above, bodies whose contact may pull do not rebound,
  /// and there is no t_col. (If it may not pull they do, with less than
  /// least_restitution_without_pull; as eq. (4) does not hold for them, that does not count as a
  /// rebound here.)
  bool rebounds() const;
  /// s: eq. (4), pi / omega, if the contact may pull. If not, it pushes for (2 / omega)
  /// arctan(2 omega / gamma_N), and the bodies separate in another gamma_N m_red / k_N. Throws
  /// std::domain_error, as restitution() does, for a contact that does not rebound.
  double collision_time() const;
  /// e_N = exp(-pi gamma_N / (2 omega)) if the contact may pull. Larger if not, as then the damping
  /// ends when the force has come down to zero.
  double restitution() const;
};

/// The contact of two bodies under a linear law, whatever its damping; nothing under another one.
std::optional<LinearContact> linear_contact(const NormalLaw& normal, double reduced_mass,
                                            Attraction attraction = Attraction::keep);

/// Restitution at critical damping of a linear contact that may not pull: exp(-2). With more
/// damping it is exp(-(beta/Omega) ln((beta + Omega)/(beta - Omega))), where beta = gamma_N/2 and
/// Omega^2 = beta^2 - k_N/m_red.
inline constexpr double least_restitution_without_pull = 0.13533528323661270;

/// 1/s, the gamma_N below critical damping that gives restitution 0 < e_N <= 1 to a linear contact.
/// Throws std::domain_error if it may not pull and e_N is not above least_restitution_without_pull.
double damping_for_restitution(double restitution, double k_n, double reduced_mass,
                               Attraction attraction);

/// The elastic part of any law.
ElasticLine elastic_line(const NormalLaw& normal);

/// s, duration of an undamped head-on contact under F = k xi^alpha that begins with `speed` (m/s).
/// For alpha = 1 it does not depend on the speed; for any other alpha it is NaN at speed 0.
double elastic_collision_time(const ElasticLine& line, double reduced_mass, double speed);

/// m, largest overlap of the same contact: an upper bound for a damped one.
double elastic_max_overlap(const ElasticLine& line, double reduced_mass, double speed);

/// s, duration of a head-on contact under `normal`: LinearContact::collision_time() for a linear
/// law, else that without damping. Throws std::domain_error for a linear contact that does not
/// rebound.
double collision_time(const NormalLaw& normal, double reduced_mass, double speed,
                      Attraction attraction = Attraction::keep);

/// The factor by which a tangential force changes the slip of two bodies more than if they did not
/// rotate. Their moment of inertia is `inertia` m r^2 (0: they do not rotate).
double slip_gain_by_turning(double inertia);

/// s, half a period of the tangential spring between two bodies whose moment of inertia is
/// `inertia` m r^2 (0: they do not rotate); infinite for slip laws without a spring.
double spring_time(const SlipLaw& slip, double inertia, double reduced_mass);

/// m, chord of a straight passage at `impact_height` (m from the centre) through a circle of radius
/// `reach` (m); NaN if it passes by.
double chord(double reach, double impact_height);

/// m, the chord through a circle of radius `reach` at the depth to which a body sinks in a head-on
/// contact of duration `t_col` (s) that begins with `speed` (m/s): speed t_col / pi, as by linear
/// springs. (Hertz' law goes 7 % deeper, which changes the chord by 3 %.)
double chord_of_impact(double reach, double speed, double t_col);

/// m/s, v_crit: a body that passes the chord (m) faster is through before `t_col` (s) has passed.
double critical_velocity(double chord, double t_col);

}  // namespace riesel
