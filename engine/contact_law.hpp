// The contact laws: one small type each, with its formula and its source. They are values, inlined
// into the one contact loop and chosen once per call of that loop.
//
// To add a normal law: write its type here and add it to NormalLaw (or keep it outside of the
// library: OuterLaw, docs/extending.md). A type provides
//   elastic(xi)                    N, the part that stores energy
//   damping(xi, rate, m_red)       N, the part that dissipates, of the sign of `rate`
//   stored_energy(xi)              J
//   elastic_line()                 k and alpha of elastic(xi) = k xi^alpha, for the contact time
// with xi > 0 the overlap in m, `rate` = d(xi)/dt in m/s and m_red the reduced mass in kg. To add a
// slip law: the same with SlipLaw; a type provides force(limit, slip, half_step_slip, m_red, dt).
//
// Source, unless said otherwise: Schaefer and Wolf, Phys. Rev. E 51, 6154 (1995).
#pragma once

#include "engine/elastic_line.hpp"
#include "engine/outer_law.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

namespace riesel {

/// Eq. (1): F_N = k_N xi + gamma_N m_red d(xi)/dt.
struct LinearLaw {
  double k_n;      ///< N/m
  double gamma_n;  ///< 1/s

  double elastic(double xi) const { return k_n * xi; }
  double damping(double, double rate, double m_red) const { return gamma_n * m_red * rate; }
  double stored_energy(double xi) const { return 0.5 * k_n * xi * xi; }
  ElasticLine elastic_line() const { return {k_n, 1.0}; }
};

/// Eq. (3): F_N = k xi^alpha + gamma xi^beta (d(xi)/dt)^g, odd in the rate.
struct PowerLaw {
  double k;      ///< N/m^alpha
  double gamma;  ///< N / (m^beta (m/s)^g)
  double alpha, beta, g;

  double elastic(double xi) const { return k * std::pow(xi, alpha); }
  double damping(double xi, double rate, double) const {
    return std::copysign(gamma * std::pow(xi, beta) * std::pow(std::abs(rate), g), rate);
  }
  double stored_energy(double xi) const { return k * std::pow(xi, alpha + 1.0) / (alpha + 1.0); }
  ElasticLine elastic_line() const { return {k, alpha}; }
};

/// Hertz, with the viscoelastic damping of Kuwabara and Kono, Jpn. J. Appl. Phys. 26, 1230 (1987):
/// eq. (3) with alpha = 3/2, beta = 1/2, g = 1.
struct HertzKuwabaraKonoLaw {
  double k;      ///< N/m^(3/2)
  double gamma;  ///< N s/m^(3/2)

  double elastic(double xi) const { return k * xi * std::sqrt(xi); }
  double damping(double xi, double rate, double) const { return gamma * std::sqrt(xi) * rate; }
  double stored_energy(double xi) const { return 0.4 * k * xi * xi * std::sqrt(xi); }
  ElasticLine elastic_line() const { return {k, 1.5}; }
};

using NormalLaw = std::variant<LinearLaw, PowerLaw, HertzKuwabaraKonoLaw, OuterLaw>;

/// Eq. (2), F_S = -limit sgn(v_S), but never more than the force that stops the slip within the
/// step: what the equation means as dt -> 0. The slip that a step's kick can stop is that of the
/// leapfrog velocity.
struct CappedSlip {
  double force(double limit, double, double half_step_slip, double m_red, double dt) const {
    return -std::max(-limit, std::min(limit, m_red * half_step_slip / dt));
  }
};

/// Eq. (2) taken literally: at zero slip the sign chatters by limit dt / m_red each step.
struct LiteralSlip {
  double force(double limit, double, double half_step_slip, double, double) const {
    return half_step_slip == 0.0 ? 0.0 : -std::copysign(limit, half_step_slip);
  }
};

/// F_S = -min(limit, gamma_t m_red |v_S|) sgn(v_S): eq. (2) made smooth at small slip.
struct ViscousSlip {
  double gamma_t;  ///< 1/s

  double force(double limit, double slip, double, double m_red, double) const {
    return -std::max(-limit, std::min(limit, gamma_t * m_red * slip));
  }
};

using SlipLaw = std::variant<CappedSlip, LiteralSlip, ViscousSlip>;

/// Near the end of a contact the damping of eq. (1) pulls: either as the equation says, or cut off
/// at zero.
enum class Attraction { keep, clip };

/// All that two bodies in contact do to each other.
struct ContactModel {
  NormalLaw normal;
  SlipLaw slip;
  double friction = 0.0;  ///< mu
  Attraction attraction = Attraction::keep;
};

}  // namespace riesel
