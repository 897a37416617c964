// The general power law, eq. (3), contains the two special laws.
#include "tests/catch.hpp"
#include "tests/physics/collisions.hpp"

#include <cmath>
#include <limits>
#include <numbers>

using namespace collisions;

namespace {

/// A wall contact, oblique, with friction: everything that depends on the normal force.
Outcome oblique(const NormalLaw& law) {
  ContactModel model = paper_model();
  model.normal = law;
  return hit_wall_grain(grain(0.996e-3, -0.415e-3, -1.0, 0.3), wall_radius, model, time_step);
}

void check_equal(const Outcome& a, const Outcome& b) {
  // pow() may round differently from sqrt() and products: a few 1e-16 per step
  CHECK((a.velocity - b.velocity).norm() < 1e-12);
  CHECK(std::abs(a.contact_time() / b.contact_time() - 1.0) < 1e-9);
  CHECK(std::abs(a.tally.max_overlap / b.tally.max_overlap - 1.0) < 1e-12);
  CHECK(std::abs(a.losses() / b.losses() - 1.0) < 1e-11);
}

}  // namespace

TEST_CASE("eq. (3) with alpha = 1, beta = 0, g = 1 is eq. (1)") {
  check_equal(oblique(PowerLaw{stiffness, damping * mass, 1.0, 0.0, 1.0}),
              oblique(LinearLaw{stiffness, damping}));
}

TEST_CASE("eq. (3) with alpha = 3/2, beta = 1/2, g = 1 is Hertz-Kuwabara-Kono") {
  check_equal(oblique(PowerLaw{5e5, 3.3, 1.5, 0.5, 1.0}), oblique(HertzKuwabaraKonoLaw{5e5, 3.3}));
}

TEST_CASE(
    "Hertz with damping as the fourth root of the overlap has one restitution for all speeds") {
  // With xi^(5/4) in the place of xi it is a linear contact: Antypov and Elliott, EPL 94, 50004.
  constexpr double restitution = 0.8, stiff = 5e5;
  const double log_e = std::log(restitution);
  const double damped =
      -log_e / std::hypot(log_e, std::numbers::pi) * std::sqrt(5.0 * stiff * mass);
  ContactModel model = frictionless(0.0);
  model.normal = PowerLaw{stiff, damped, 1.5, 0.25, 1.0};
  const double speed = GENERATE(0.1, 1.0, 10.0);
  const HeadOn head_on_wall{.mass_1 = mass,
                            .mass_2 = std::numeric_limits<double>::infinity(),
                            .speed = speed,
                            .dt = collision_time(model.normal, mass, speed) / 400.3};
  CHECK(std::abs(head_on(head_on_wall, model).restitution - restitution) < 5e-4);
}

TEST_CASE("the damping of eq. (3) is odd in the rate") {
  const PowerLaw law{2000.0, 0.3, 1.0, 0.5, 1.5};
  CHECK(law.damping(1e-5, 2.0, mass) > 0.0);
  CHECK(law.damping(1e-5, -2.0, mass) == -law.damping(1e-5, 2.0, mass));
}

TEST_CASE("the stored energy of each law is the work against its elastic force") {
  const NormalLaw law =
      GENERATE(NormalLaw(LinearLaw{stiffness, damping}), NormalLaw(HertzKuwabaraKonoLaw{5e5, 3.3}),
               NormalLaw(PowerLaw{2e4, 1.0, 1.2, 0.3, 1.0}),
               NormalLaw(EqualRestitutionLaw{{stiffness, 7.0}}));
  std::visit(
      [](const auto& l) {
        const double xi = 2e-5, h = 1e-9;
        const double slope = (l.stored_energy(xi + h) - l.stored_energy(xi - h)) / (2.0 * h);
        CHECK(std::abs(slope / l.elastic(xi) - 1.0) < 1e-6);  // (h / xi)^2 and rounding
        CHECK(l.stored_energy(0.0) == 0.0);
        const ElasticLine line = l.elastic_line();
        CHECK(std::abs(line.stiffness * std::pow(xi, line.exponent) / l.elastic(xi) - 1.0) < 1e-12);
      },
      law);
}
