#include "engine/closed_forms.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace riesel {

using std::numbers::pi;

namespace {

/// 1/s^2, square of the angular frequency of the damped oscillation.
double frequency_squared(const LinearContact& c) {
  return c.k_n / c.reduced_mass - 0.25 * c.gamma_n * c.gamma_n;
}

/// 1/s
double frequency(const LinearContact& c) {
  if (!c.rebounds()) throw std::domain_error("an overdamped contact does not end");
  return std::sqrt(frequency_squared(c));
}

/// -ln e_N of a contact that may not pull, as a function of decay = gamma_N / 2 times half a
/// period: its force vanishes after the part 2/pi arctan(pi / decay) of that.
double pushed_decay(double decay) { return 2.0 / pi * decay * std::atan2(pi, decay); }

double slope_of_pushed_decay(double decay) {
  return 2.0 / pi * std::atan2(pi, decay) - 2.0 * decay / (pi * pi + decay * decay);
}

/// The inverse of pushed_decay(), by Newton's method. As the slope falls, steps from below never
/// overshoot; rounding ends them when they do not go up any more.
double decay_by_pushed(double pushed) {
  double decay = pushed;
  while (true) {
    const double next = decay + (pushed - pushed_decay(decay)) / slope_of_pushed_decay(decay);
    if (!(next > decay)) return decay;
    decay = next;
  }
}

}  // namespace

bool LinearContact::rebounds() const { return frequency_squared(*this) > 0.0; }

double LinearContact::collision_time() const {
  const double omega = frequency(*this);
  if (attraction == Attraction::keep) return pi / omega;
  const double pushes = 2.0 / omega * std::atan2(omega, 0.5 * gamma_n);
  const double separates = gamma_n * reduced_mass / k_n;  // overlap over speed, where F_N = 0
  return pushes + separates;
}

double LinearContact::restitution() const {
  const double decay = 0.5 * gamma_n * pi / frequency(*this);
  return std::exp(-(attraction == Attraction::clip ? pushed_decay(decay) : decay));
}

std::optional<LinearContact> linear_contact(const NormalLaw& normal, double reduced_mass,
                                            Attraction attraction) {
  const auto* equal = std::get_if<EqualRestitutionLaw>(&normal);
  const auto* linear = std::get_if<LinearLaw>(&normal);
  if (equal == nullptr && linear == nullptr) return std::nullopt;
  const LinearLaw law = equal != nullptr ? equal->at(reduced_mass) : *linear;
  return LinearContact{law.k_n, law.gamma_n, reduced_mass, attraction};
}

double damping_for_restitution(double restitution, double k_n, double reduced_mass,
                               Attraction attraction) {
  const bool clips = attraction == Attraction::clip;
  if (clips && !(restitution > least_restitution_without_pull))
    throw std::domain_error("no damping makes a contact that may not pull lose so much");
  // With t_col = pi / omega the decay is gamma pi / (2 omega), and omega^2 = k/m - gamma^2/4.
  const double log_e = std::log(restitution);
  const double decay = clips ? decay_by_pushed(-log_e) : -log_e;
  return 2.0 * decay * std::sqrt(k_n / reduced_mass / (pi * pi + decay * decay));
}

ElasticLine elastic_line(const NormalLaw& normal) {
  return std::visit([](const auto& law) { return law.elastic_line(); }, normal);
}

double elastic_max_overlap(const ElasticLine& line, double reduced_mass, double speed) {
  const double power = line.exponent + 1.0;
  return std::pow(power * reduced_mass * speed * speed / (2.0 * line.stiffness), 1.0 / power);
}

double elastic_collision_time(const ElasticLine& line, double reduced_mass, double speed) {
  if (line.exponent == 1.0) return pi * std::sqrt(reduced_mass / line.stiffness);
  // 2 integral from 0 to 1 of dz / sqrt(1 - z^(alpha+1)), by the beta function
  const double inverse_power = 1.0 / (line.exponent + 1.0);
  const double integral =
      2.0 * std::sqrt(pi) * std::tgamma(1.0 + inverse_power) / std::tgamma(0.5 + inverse_power);
  return integral * elastic_max_overlap(line, reduced_mass, speed) / speed;
}

double collision_time(const NormalLaw& normal, double reduced_mass, double speed,
                      Attraction attraction) {
  if (const auto linear = linear_contact(normal, reduced_mass, attraction))
    return linear->collision_time();
  return elastic_collision_time(elastic_line(normal), reduced_mass, speed);
}

double slip_gain_by_turning(double inertia) { return inertia > 0.0 ? 1.0 + 1.0 / inertia : 1.0; }

double spring_time(const SlipLaw& slip, double inertia, double reduced_mass) {
  const auto* spring = std::get_if<SpringSlip>(&slip);
  if (spring == nullptr) return std::numeric_limits<double>::infinity();
  const double slip_mass = reduced_mass / slip_gain_by_turning(inertia);
  return pi * std::sqrt(slip_mass / spring->k_t);
}

double chord(double reach, double impact_height) {
  return 2.0 * std::sqrt(reach * reach - impact_height * impact_height);
}

double chord_of_impact(double reach, double speed, double t_col) {
  const double depth = speed * t_col / pi;
  return chord(reach, std::max(0.0, reach - depth));
}

double critical_velocity(double chord, double t_col) { return chord / t_col; }

}  // namespace riesel
