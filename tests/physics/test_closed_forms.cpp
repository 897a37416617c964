// What is known of a contact on paper: against the paper's numbers, independent numbers, and
// quadrature.
#include "engine/closed_forms.hpp"
#include "tests/catch.hpp"
#include "tests/physics/reference_table.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

using namespace riesel;
using Catch::Matchers::WithinRel;
using std::numbers::pi;

namespace {

double reduced_mass(const reference::Row& row) {
  const double m1 = row("mass_1"), m2 = row("mass_2");
  return std::isinf(m2) ? m1 : m1 * m2 / (m1 + m2);
}

/// Duration of an undamped contact from conservation of energy, dt = dxi / v(xi), by the
/// substitution xi = xi_max sin^2(q), which takes the singularity away; midpoint rule.
double time_by_quadrature(double k, double alpha, double m_red, double speed) {
  const double p = alpha + 1.0;
  const double xi_max = std::pow(p * m_red * speed * speed / (2.0 * k), 1.0 / p);
  constexpr int cells = 20000;
  const double h = 0.5 * pi / cells;
  double sum = 0.0;
  for (int i = 0; i < cells; ++i) {
    const double q = (i + 0.5) * h;
    const double s = std::sin(q) * std::sin(q);
    sum += std::sin(2.0 * q) / std::sqrt(1.0 - std::pow(s, p)) * h;
  }
  return 2.0 * xi_max * sum / speed;
}

}  // namespace

TEST_CASE("eq. (4) gives the paper's collision time and restitution") {
  const LinearContact wall{.k_n = 2000.0, .gamma_n = 1e4, .reduced_mass = 1e-6};
  CHECK(wall.rebounds());
  CHECK_THAT(wall.collision_time(), WithinRel(7.07e-5, 5e-4));  // three digits are quoted
  CHECK_THAT(wall.restitution(), WithinRel(0.70, 5e-3));        // two digits are quoted
}

TEST_CASE("two equal grains collide for a shorter time than a grain and the wall") {
  const LinearContact wall{2000.0, 0.0, 1e-6}, grains{2000.0, 0.0, 0.5e-6};
  CHECK_THAT(wall.collision_time() / grains.collision_time(),
             WithinRel(std::numbers::sqrt2, 1e-14));
}

TEST_CASE("an overdamped contact has no collision time") {
  const LinearContact overdamped{.k_n = 2000.0, .gamma_n = 1e5, .reduced_mass = 1e-6};
  CHECK_FALSE(overdamped.rebounds());
  CHECK_THROWS_AS(overdamped.collision_time(), std::domain_error);
  const LinearContact critical{.k_n = 2500.0, .gamma_n = 1e5, .reduced_mass = 1e-6};
  CHECK_FALSE(critical.rebounds());
}

TEST_CASE("damping_for_restitution is the inverse of the restitution") {
  const double k = GENERATE(200.0, 2e5);
  const double m = GENERATE(0.5e-6, 3e-6);
  const auto check = [&](double e, Attraction attraction) {
    CAPTURE(e, static_cast<int>(attraction));
    const LinearContact contact{k, damping_for_restitution(e, k, m, attraction), m, attraction};
    CHECK(contact.rebounds());
    CHECK_THAT(contact.restitution(), WithinRel(e, 1e-12));
  };
  for (const double e : {1e-3, 0.1, 0.5, 0.7, 0.9, 0.999}) check(e, Attraction::keep);
  for (const double e : {0.1354, 0.2, 0.5, 0.7, 0.9, 0.999}) check(e, Attraction::clip);
}

TEST_CASE("an elastic contact needs no damping") {
  CHECK(damping_for_restitution(1.0, 2000.0, 1e-6, Attraction::keep) == 0.0);
  CHECK(damping_for_restitution(1.0, 2000.0, 1e-6, Attraction::clip) == 0.0);
}

TEST_CASE("a contact that may not pull keeps more than exp(-2) of the velocity") {
  CHECK_THAT(least_restitution_without_pull, WithinRel(std::exp(-2.0), 1e-15));
  for (const double e : {0.1353, 0.01})
    CHECK_THROWS_AS(damping_for_restitution(e, 2000.0, 1e-6, Attraction::clip), std::domain_error);
}

TEST_CASE("the closed forms agree with integrated head-on contacts") {
  // The table holds 12 digits; its integrator is good to 1e-12 (linear) and 1e-10 (Hertz).
  int linear = 0, hertz = 0, clipped = 0;
  for (const reference::Row& row : reference::table("head_on")) {
    const double k = row("k"), gamma = row("gamma"), v = row("v"), m = reduced_mass(row);
    CAPTURE(row.text("law"), k, gamma, m, v);
    if (row.text("attraction") == "clip") {  // of the other forms, those of eq. (1) as it stands
      if (row.text("law") != "linear") continue;
      const LinearContact contact{k, gamma, m, Attraction::clip};
      CHECK_THAT(contact.restitution(), WithinRel(row("restitution"), 1e-10));
      CHECK_THAT(contact.collision_time(), WithinRel(row("contact_time"), 1e-10));
      CHECK_THAT(collision_time(LinearLaw{k, gamma}, m, v, Attraction::clip),
                 WithinRel(row("contact_time"), 1e-10));
      ++clipped;
      continue;
    }
    if (row.text("law") == "linear") {
      const LinearContact contact{k, gamma, m};
      CHECK_THAT(contact.restitution(), WithinRel(row("restitution"), 1e-10));
      CHECK_THAT(contact.collision_time(), WithinRel(row("contact_time"), 1e-10));
      CHECK_THAT(collision_time(LinearLaw{k, gamma}, m, v), WithinRel(row("contact_time"), 1e-10));
      ++linear;
    }
    if (gamma != 0.0) {
      // xi_max <= v_i t_col / pi: the elastic overlap bounds the damped one
      const ElasticLine line{k, row.text("law") == "linear" ? 1.0 : 1.5};
      CHECK(row("max_overlap") < elastic_max_overlap(line, m, v));
      continue;
    }
    const ElasticLine line{k, row.text("law") == "linear" ? 1.0 : 1.5};
    CHECK_THAT(elastic_collision_time(line, m, v), WithinRel(row("contact_time"), 1e-9));
    CHECK_THAT(elastic_max_overlap(line, m, v), WithinRel(row("max_overlap"), 1e-9));
    if (row.text("law") == "hertz") ++hertz;
  }
  CHECK(linear == 14);
  CHECK(hertz == 6);
  CHECK(clipped == 3);
}

TEST_CASE("the largest overlap of an elastic linear contact is v t_col / pi") {
  const ElasticLine line{2000.0, 1.0};
  const double v = 3.0, m = 1e-6;
  CHECK_THAT(elastic_max_overlap(line, m, v),
             WithinRel(v * elastic_collision_time(line, m, v) / pi, 1e-13));
}

TEST_CASE("the elastic contact time agrees with quadrature of the energy integral") {
  // 20000 midpoints of a smooth integrand: 1e-8.
  const double alpha = GENERATE(1.0, 1.25, 1.5, 2.0, 3.0);
  const double v = GENERATE(0.1, 1.0, 10.0);
  const double k = 5e5, m = 0.75e-6;
  CAPTURE(alpha, v);
  CHECK_THAT(elastic_collision_time({k, alpha}, m, v),
             WithinRel(time_by_quadrature(k, alpha, m, v), 1e-7));
}

TEST_CASE("a Hertz contact is shorter the faster it is, as v^(-1/5)") {
  const HertzKuwabaraKonoLaw law{5e5, 3.3};
  CHECK_THAT(collision_time(law, 1e-6, 32.0) / collision_time(law, 1e-6, 1.0),
             WithinRel(0.5, 1e-13));
}

TEST_CASE("the general power law has the contact time of the laws that it contains") {
  const double m = 1e-6, v = 2.0;
  CHECK_THAT(collision_time(PowerLaw{5e5, 3.3, 1.5, 0.5, 1.0}, m, v),
             WithinRel(collision_time(HertzKuwabaraKonoLaw{5e5, 3.3}, m, v), 1e-14));
  CHECK_THAT(collision_time(PowerLaw{2000.0, 0.0, 1.0, 0.0, 1.0}, m, v),
             WithinRel(collision_time(LinearLaw{2000.0, 0.0}, m, v), 1e-14));
}

TEST_CASE("the chord runs from the rim to the diameter") {
  CHECK(chord(0.83e-3, 0.83e-3) == 0.0);
  CHECK(chord(0.83e-3, 0.0) == 2.0 * 0.83e-3);
  CHECK_THAT(chord(5.0, 3.0), WithinRel(8.0, 1e-15));
}
