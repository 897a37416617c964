// The contact laws: one small type each, with its formula and its source. Their functions are
// inlined into the one contact loop, which is compiled for each of them and chosen once per call.
//
// To add a normal law: write its type here and add it to NormalLaw (or keep it outside of the
// library: OuterLaw, docs/extending.md). A type provides
//   elastic(xi)                    N, the part that stores energy
//   damping(xi, rate, m_red)       N, the part that dissipates, of the sign of `rate`
//   stored_energy(xi)              J
//   elastic_line()                 k and alpha of elastic(xi) = k xi^alpha, for the contact time
// with xi > 0 the overlap in m, `rate` = d(xi)/dt in m/s and m_red the reduced mass in kg. To add a
// slip law: the same with SlipLaw; a type provides
//   force(sliding)                 N along s, on the first body
//   has_spring                     whether its contacts have a history, the elongation of a spring;
// and if so
//   elongation(sliding)            m, of the spring after this step, limited by friction
//   stored_energy(elongation)      J
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

/// Eq. (1) with gamma_N proportional to m_red^(-1/2). As e_N depends on gamma_N^2 m_red / k_N, all
/// pairs have the same, whatever their masses.
struct EqualRestitutionLaw {
  LinearLaw at_one_kilogram;  ///< of reduced mass

  LinearLaw at(double m_red) const {
    return {at_one_kilogram.k_n, at_one_kilogram.gamma_n / std::sqrt(m_red)};
  }
  double elastic(double xi) const { return at_one_kilogram.elastic(xi); }
  double damping(double, double rate, double m_red) const {
    return at_one_kilogram.gamma_n * std::sqrt(m_red) * rate;
  }
  double stored_energy(double xi) const { return at_one_kilogram.stored_energy(xi); }
  ElasticLine elastic_line() const { return at_one_kilogram.elastic_line(); }
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

using NormalLaw =
    std::variant<LinearLaw, EqualRestitutionLaw, PowerLaw, HertzKuwabaraKonoLaw, OuterLaw>;

/// What a slip law knows of a contact. The slip is the velocity of the surface of the first body
/// relative to that of the second, along s (Contact).
struct Sliding {
  double limit;           ///< N, mu |F_N|, mean over the step
  double present_limit;   ///< N, mu |F_N| at the full step
  double slip;            ///< m/s, at the full step
  double half_step_slip;  ///< m/s, half a step before
  double spring;          ///< m, elongation of the tangential spring with the slip of this step
  double weight;          ///< the part of the step in which the bodies are in touch
  double reduced_mass;    ///< kg
  double slip_mass;       ///< kg, inertia of the slip: m_red, or less where the bodies rotate
  double per_dt;          ///< 1/s, of the time step
};

/// `force` restricted to [-limit, limit].
[[gnu::always_inline]] inline double capped(double limit, double force) {
  return std::max(-limit, std::min(limit, force));
}

/// Eq. (2), F_S = -limit sgn(v_S), but never more than the force that stops the slip within the
/// step: what the equation means as dt -> 0. The slip that a step's kick can stop is that of the
/// leapfrog velocity.
struct CappedSlip {
  static constexpr bool has_spring = false;

  double force(const Sliding& s) const {
    return capped(s.limit, -(s.slip_mass * s.half_step_slip * s.per_dt));
  }
};

/// Eq. (2) taken literally: near zero slip the sign alternates, and the slip jumps by limit dt /
/// m_red in each step.
struct LiteralSlip {
  static constexpr bool has_spring = false;

  double force(const Sliding& s) const {
    return s.half_step_slip == 0.0 ? 0.0 : -std::copysign(s.limit, s.half_step_slip);
  }
};

/// F_S = -min(limit, gamma_t m_red |v_S|) sgn(v_S): eq. (2) made smooth at small slip.
struct ViscousSlip {
  static constexpr bool has_spring = false;

  double gamma_t;  ///< 1/s

  double force(const Sliding& s) const {
    return capped(s.limit, -(gamma_t * s.reduced_mass * s.slip));
  }
};

/// F_S = -(k_t zeta + gamma_t m_red v_S), at most the limit: Cundall and Strack, Geotechnique 29,
/// 47 (1979). The elongation zeta is the distance slipped, cut off where the spring alone reaches
/// the limit: then the contact slides. So the spring stores no energy that it did not receive,
/// which one that is adjusted so that spring and damping together match the limit might do.
struct SpringSlip {
  static constexpr bool has_spring = true;

  double k_t;      ///< N/m
  double gamma_t;  ///< 1/s

  double elongation(const Sliding& s) const { return capped(s.present_limit / k_t, s.spring); }
  double force(const Sliding& s) const {
    const double present = k_t * elongation(s) + gamma_t * s.reduced_mass * s.slip;
    return capped(s.limit, -(s.weight * present));
  }
  double stored_energy(double elongation) const { return 0.5 * k_t * elongation * elongation; }
};

using SlipLaw = std::variant<CappedSlip, LiteralSlip, ViscousSlip, SpringSlip>;

/// Near the end of a contact the damping of eq. (1) makes F_N negative, an attraction: this is kept
/// as the equation says, or clipped to zero.
enum class Attraction { keep, clip };

/// All that two bodies in contact do to each other.
struct ContactModel {
  NormalLaw normal;
  SlipLaw slip;
  double friction = 0.0;  ///< mu
  Attraction attraction = Attraction::keep;
  double rolling_friction = 0.0;  ///< mu_r, of grains that rotate
};

}  // namespace riesel
