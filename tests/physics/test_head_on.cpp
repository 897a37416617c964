// Head-on collisions by the engine: restitution, duration and overlap are those of the closed
// forms, and what is missing vanishes with the second power of the time step.
//
// Where in a time step a contact begins and ends is chance. With damping, statements on accuracy
// are therefore statements on the mean over these phases, and the worst phase is bounded
// separately.
#include "engine/closed_forms.hpp"
#include "engine/impact.hpp"
#include "tests/catch.hpp"
#include "tests/physics/collisions.hpp"
#include "tests/physics/reference_table.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

using namespace collisions;
using std::numbers::pi;

namespace {

constexpr double wall = std::numeric_limits<double>::infinity();  // mass of a wall grain

/// xi_max of eq. (1), where d(xi)/dt = 0 for the first time: before any attraction.
double max_overlap(LinearContact c, double v) {
  c.attraction = Attraction::keep;
  const double omega = pi / c.collision_time();
  const double t = std::atan2(omega, 0.5 * c.gamma_n) / omega;
  return v / omega * std::exp(-0.5 * c.gamma_n * t) * std::sin(omega * t);
}

/// Relative errors over the phases of the contact's begin.
struct Errors {
  double mean_restitution = 0.0, worst_restitution = 0.0;
  double worst_time = 0.0;
  double worst_overlap = 0.0;
};

/// For about this many steps per collision: never a whole number, for which begin and end would
/// have the same phase and their errors cancel.
Errors errors(double mass_2, double gamma, double steps_per_collision,
              Attraction attraction = Attraction::keep) {
  const double v = 1.0;
  HeadOn h{.mass_1 = mass, .mass_2 = mass_2, .speed = v, .dt = 0.0};
  const LinearContact contact{stiffness, gamma, h.reduced_mass(), attraction};
  ContactModel model = frictionless(gamma);
  model.attraction = attraction;
  constexpr int phases = 32;
  Errors sum;
  for (int i = 0; i < phases; ++i) {
    h.phase = (i + 0.5) / phases;
    h.dt = contact.collision_time() / (steps_per_collision + std::fmod(std::numbers::phi * i, 1.0));
    const Rebound r = head_on(h, model);
    const double e = r.restitution / contact.restitution() - 1.0;
    const double t = r.contact_time / contact.collision_time() - 1.0;
    const double xi = r.max_overlap / max_overlap(contact, v) - 1.0;
    sum.mean_restitution += e / phases;
    sum.worst_restitution = std::max(sum.worst_restitution, std::abs(e));
    sum.worst_time = std::max(sum.worst_time, std::abs(t));
    sum.worst_overlap = std::max(sum.worst_overlap, std::abs(xi));
  }
  return sum;
}

/// The p of error ~ dt^p, by least squares over t_col/dt = 25, 50, ... 400.
double order(const std::array<double, 5>& error) {
  double sum = 0.0;
  for (int i = 0; i < 5; ++i) sum += (2 - i) * std::log2(error[static_cast<std::size_t>(i)]);
  return sum / 10.0;
}

}  // namespace

TEST_CASE("a contact resolved by 50 steps comes out to parts in a thousand") {
  // The paper's eq. (5) promises "of order 1e-4" for t_col / 50. Second-order terms are
  // (pi/50)^2/24 = 1.6e-4 with factors of order one before them.
  const double partner = GENERATE(as<double>{}, wall, 1e-6, 3e-6);
  const double gamma = GENERATE(0.0, 1e4);
  CAPTURE(partner, gamma);
  const Errors e = errors(partner, gamma, 50.0);
  CHECK((gamma > 0.0 ? std::abs(e.mean_restitution) : e.worst_restitution) < 1e-3);
  CHECK(e.worst_time < 5e-4);
  CHECK(e.worst_overlap < 1e-3);  // the top of the parabola is sampled: (pi/100)^2 / 2 = 5e-4
}

TEST_CASE("under equal restitution all pairs rebound alike, whatever their masses") {
  const double expected = GENERATE(0.3, 0.7, 0.95);
  const double partner = GENERATE(as<double>{}, wall, 1e-8, 1e-6, 3e-5);
  CAPTURE(expected, partner);
  const double loss = -std::log(expected);  // gamma_N t_col / 2; with eq. (4) for gamma_N m^(1/2):
  ContactModel model = frictionless(0.0);
  model.normal =
      EqualRestitutionLaw{{stiffness, 2.0 * std::sqrt(stiffness) * loss / std::hypot(pi, loss)}};
  HeadOn h{.mass_1 = mass, .mass_2 = partner, .speed = 0.4, .dt = 0.0};
  const double omega0 = std::sqrt(stiffness / h.reduced_mass());
  const double t_col = std::hypot(pi, loss) / omega0;
  h.dt = t_col / 100.3;
  constexpr int phases = 32;
  double restitution = 0.0;
  for (int i = 0; i < phases; ++i) {
    h.phase = (i + 0.5) / phases;
    const Rebound r = head_on(h, model);
    restitution += r.restitution / phases;
    CHECK(std::abs(r.contact_time / t_col - 1.0) < 5e-4);
  }
  CHECK(std::abs(restitution / expected - 1.0) < 1e-3);
}

TEST_CASE("no phase of the contact's begin costs more than one step of damping") {
  // Where a contact begins or ends within a hair of a full step, half a step of damping may count
  // twice or not at all: gamma dt / 2 of the velocity. Twice that is the promise.
  const double gamma = 1e4;
  const double steps = GENERATE(25.0, 50.0, 100.0);
  const double dt = LinearContact{stiffness, gamma, mass}.collision_time() / steps;
  CHECK(errors(wall, gamma, steps).worst_restitution < gamma * dt);
}

TEST_CASE("head-on collisions converge at second order in the time step") {
  const double partner = GENERATE(as<double>{}, wall, 1e-6, 3e-6);
  const double gamma = GENERATE(0.0, 1e4);
  const Attraction attraction = GENERATE(Attraction::keep, Attraction::clip);
  CAPTURE(partner, gamma, attraction == Attraction::clip);
  std::array<double, 5> restitution{}, time{}, overlap{};
  double steps = 25.0;
  for (std::size_t i = 0; i < 5; ++i, steps *= 2.0) {
    const Errors e = errors(partner, gamma, steps, attraction);
    restitution[i] = gamma > 0.0 ? std::abs(e.mean_restitution) : e.worst_restitution;
    time[i] = e.worst_time;
    overlap[i] = e.worst_overlap;
  }
  CHECK(std::abs(order(restitution) - 2.0) < 0.15);
  CHECK(std::abs(order(time) - 2.0) < 0.25);
  CHECK(overlap[4]
        < 2e-5);  // the top of the parabola, sampled: (pi / 800)^2 / 2 = 8e-6 and second order
}

TEST_CASE("an elastic collision conserves energy, and at random phases without bias") {
  // The force begins and ends with a kink somewhere in a step: up to (pi/50)^2 / 8 = 5e-4 for one
  // collision, of either sign.
  const double partner = GENERATE(as<double>{}, wall, 1e-6, 3e-6);
  const Errors e = errors(partner, 0.0, 50.0);
  CHECK(e.worst_restitution < 5e-4);
  CHECK(std::abs(e.mean_restitution) < 2e-5);
}

TEST_CASE("head-on collisions of all laws are those of the reference") {
  // Steps of t / 2000. What is left is of second order for eq. (1): 2e-6 at most; and of order 3/2
  // for Hertz-Kuwabara-Kono, whose damping begins as a square root: 1e-5.
  constexpr double tolerance = 2e-5;
  for (const reference::Row& row : reference::table("head_on")) {
    const bool linear = row.text("law") == "linear", clip = row.text("attraction") == "clip";
    const double k = row("k"), gamma = row("gamma");
    CAPTURE(row.text("law"), row.text("attraction"), row("mass_2"), k, gamma, row("v"));
    ContactModel model = frictionless(0.0);
    model.normal = linear ? NormalLaw(LinearLaw{k, gamma}) : HertzKuwabaraKonoLaw{k, gamma};
    model.attraction = clip ? Attraction::clip : Attraction::keep;
    const Rebound r = head_on({.mass_1 = row("mass_1"),
                               .mass_2 = row("mass_2"),
                               .speed = row("v"),
                               .dt = row("contact_time") / 2000.0,
                               .phase = 0.5},
                              model);
    CHECK(std::abs(r.restitution / row("restitution") - 1.0) < tolerance);
    CHECK(std::abs(r.contact_time / row("contact_time") - 1.0) < tolerance);
    CHECK(std::abs(r.max_overlap / row("max_overlap") - 1.0) < tolerance);
  }
}

TEST_CASE("the restitution of any law is told by an impact") {
  ContactModel model = frictionless(0.0);
  CHECK(restitution(model, mass, 0.3).value() == Approx(1.0).epsilon(1e-6));
  model = frictionless(damping);
  model.attraction = GENERATE(Attraction::keep, Attraction::clip);
  const LinearContact linear{stiffness, damping, mass, model.attraction};
  CHECK(restitution(model, mass, 2.0).value() == Approx(linear.restitution()).epsilon(1e-3));
  // Antypov and Elliott, as in test_general_law.cpp: the same at all speeds
  const double log_e = std::log(0.8), stiff = 5e5;
  model.attraction = Attraction::keep;
  model.normal = PowerLaw{stiff, -log_e / std::hypot(log_e, pi) * std::sqrt(5.0 * stiff * mass),
                          1.5, 0.25, 1.0};
  for (const double speed : {1e-3, 1.0, 30.0})
    CHECK(restitution(model, mass, speed).value() == Approx(0.8).epsilon(1e-3));
}

TEST_CASE("bodies with too much damping have no restitution") {
  // Twice the critical damping of 2000 N/m and 1 mg is 1.8e5 1/s; as eq. (3) has it, and far more.
  ContactModel model = frictionless(0.0);
  for (const double gamma : {1.8e5, 1e7, 1e12}) {
    model.normal = PowerLaw{stiffness, gamma * mass, 1.0, 0.0, 1.0};
    CAPTURE(gamma, restitution(model, mass, 1.0).value_or(-1.0));
    CHECK_FALSE(restitution(model, mass, 1.0));
  }
}
