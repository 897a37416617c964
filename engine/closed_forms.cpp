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

}  // namespace

bool LinearContact::rebounds() const { return frequency_squared(*this) > 0.0; }

double LinearContact::collision_time() const {
  if (!rebounds()) throw std::domain_error("an overdamped contact does not end");
  return pi / std::sqrt(frequency_squared(*this));
}

double LinearContact::restitution() const { return std::exp(-0.5 * gamma_n * collision_time()); }

double damping_for_restitution(double restitution, double k_n, double reduced_mass) {
  // With t_col = pi / omega, ln e = -gamma pi / (2 omega), and omega^2 = k/m - gamma^2/4.
  const double log_e = std::log(restitution);
  return -2.0 * log_e * std::sqrt(k_n / reduced_mass / (pi * pi + log_e * log_e));
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

double collision_time(const NormalLaw& normal, double reduced_mass, double speed) {
  if (const auto* linear = std::get_if<LinearLaw>(&normal))
    return LinearContact{linear->k_n, linear->gamma_n, reduced_mass}.collision_time();
  return std::visit(
      [&](const auto& law) {
        return elastic_collision_time(law.elastic_line(), reduced_mass, speed);
      },
      normal);
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

}  // namespace riesel
