// Friction: Coulomb's law where the contact slides, and what becomes of sgn(v_S) where the slip
// stops.
#include "engine/closed_forms.hpp"
#include "tests/catch.hpp"
#include "tests/physics/collisions.hpp"
#include "tests/physics/reference_table.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

using namespace collisions;

namespace {

/// The velocity along a flat wall at each step, from the first touch to the first step after the
/// last.
std::vector<double> slips(const ContactModel& model, double normal, double along, double dt) {
  Simulation simulation(above_flat_wall(normal, along, dt), model, 1);
  std::vector<double> slip;
  while (simulation.state().tally.walls.ended == 0) {
    simulation.advance(1);
    if (simulation.state().tally.walls.begun > 0)
      slip.push_back(grain_at(simulation.state(), 0).vy);
  }
  return slip;
}

}  // namespace

TEST_CASE("a sliding elastic contact gives mu times the normal impulse along the wall") {
  // Every kick keeps the ratio exactly; the normal turns by v_S t_col / R = 4e-5 meanwhile.
  const double mu = GENERATE(0.1, 0.5, 1.0);
  ContactModel model = frictionless(0.0);
  model.friction = mu;
  const SlipLaw slip = GENERATE(SlipLaw(CappedSlip{}), SlipLaw(LiteralSlip{}));
  model.slip = slip;
  const double normal = 1.0, along = 5.0;
  const Outcome out = collide(above_flat_wall(normal, along, step_of(0.0)), model);
  const double normal_impulse = out.velocity.x() + normal;
  const double friction_impulse = along - out.velocity.y();
  CHECK(std::abs(friction_impulse / normal_impulse - mu) < 1e-4);
}

TEST_CASE("without friction the velocity along the wall does not change") {
  const Outcome out = collide(above_flat_wall(1.0, 5.0, step_of(1e4)), frictionless(1e4));
  CHECK(std::abs(out.velocity.y() - 5.0) < 1e-4);  // the normal turns by 4e-5
}

TEST_CASE("friction dissipates what the motion along the wall loses") {
  const ContactModel model = paper_model();
  const Outcome out = collide(above_flat_wall(1.0, 5.0, step_of(damping)), model);
  const double lost = 0.5 * mass * (5.0 * 5.0 - std::pow(out.velocity.y(), 2));
  CHECK(std::abs(out.tally.friction_loss.value() / lost - 1.0) < 1e-3);
}

TEST_CASE("capped friction stops the slip and never reverses it") {
  const double along =
      GENERATE(0.05, 0.3, 0.7);  // mu (1 + e) v_n = 0.85 m/s is what friction can stop
  const std::vector<double> slip = slips(paper_model(), 1.0, along, step_of(damping));
  constexpr double turn = 5e-6;  // of the normal, in 0.05 mm; what sticks to the wall turns with it
  for (const double v : slip) CHECK(std::abs(v) < along + turn);
  for (const double v : slip) CHECK(v > -turn);
  CHECK(slip.back() < turn);
}

TEST_CASE("the literal sign chatters, by no more than one kick of friction") {
  ContactModel model = paper_model();
  model.slip = LiteralSlip{};
  const double normal = 1.0, dt = step_of(damping);
  const std::vector<double> slip = slips(model, normal, 0.05, dt);
  // |F_N| is largest at the first touch (gamma m v) or at the largest overlap (k v t_col / pi).
  const double strongest =
      std::max(1.5 * damping * mass * normal, std::sqrt(stiffness * mass) * normal);
  const double kick = friction * strongest * dt / mass;
  int reversals = 0;
  bool stopped = false;
  for (std::size_t i = 1; i < slip.size(); ++i) {
    if (slip[i] * slip[i - 1] < 0.0) {
      stopped = true;
      ++reversals;
    }
    if (stopped) CHECK(std::abs(slip[i]) <= kick);
  }
  CHECK(reversals > 10);
}

TEST_CASE("viscous slip tends to the capped one as its rate grows") {
  // An impact whose slip stops. The explicit step is stable for gamma_t dt < 2.
  const double dt = LinearContact{stiffness, damping, mass}.collision_time() / 200.0;
  const auto hit = [&](const SlipLaw& slip) {
    ContactModel model = paper_model();
    model.slip = slip;
    return hit_wall_grain(grain(0.996e-3, -0.415e-3, -1.0, 0.0), wall_radius, model, dt).velocity;
  };
  const Vector2d capped = hit(CappedSlip{});
  double last = 1.0;
  for (const double gamma_t : {1e3, 1e4, 1e5, 3e5, 1e6}) {
    const double difference = (hit(ViscousSlip{gamma_t}) - capped).norm();
    CHECK(difference < 0.7 * last);
    last = difference;
  }
  CHECK(last < 1e-4);
}

TEST_CASE("the step follows damping of the slip up to gamma_t dt = 1") {
  // With v(n) predicted as w(n-1/2) + a(n-1) dt/2, slips of alternating sign die out below and
  // grow beyond.
  const double dt = step_of(0.0), part = GENERATE(0.9, 1.1);
  ContactModel model = frictionless(0.0);
  model.friction = 1.0;
  model.slip = ViscousSlip{part / dt};
  const std::vector<double> slip = slips(model, 1.0, 1e-3, dt);
  REQUIRE(slip.size() > 40);
  CHECK((std::abs(slip[40]) < 0.1 * std::abs(slip[10])) == (part < 1.0));
  CHECK((std::abs(slip[40]) > std::abs(slip[10])) == (part > 1.0));
}

TEST_CASE("oblique impacts are those of the reference, whether they slide, stick or are clipped") {
  // t / 1000. Left over: second order, 1e-6; a clipped force, a stop of the slip or the root of
  // Hertz's damping falls somewhere in a step, 1e-3 of a contact's duration, weighted with the
  // small force at that moment.
  int stuck = 0;
  for (const reference::Row& row : reference::table("oblique")) {
    const double k = row("k"), gamma = row("gamma");
    const bool linear = row.text("law") == "linear";
    CAPTURE(row.text("law"), row.text("attraction"), row("b_over_R"), row("x"), gamma, row("mu"));
    const ContactModel model{
        linear ? NormalLaw(LinearLaw{k, gamma}) : HertzKuwabaraKonoLaw{k, gamma}, CappedSlip{},
        row("mu"), row.text("attraction") == "clip" ? Attraction::clip : Attraction::keep};
    const Grain start{row("x"), row("y"), row("vx"), row("vy"), row("radius_free"), row("mass")};
    const Outcome out =
        hit_wall_grain(start, row("radius_wall"), model, row("contact_time") / 1000.0);
    const Vector2d expected(row("vx_after"), row("vy_after"));
    const double speed = std::hypot(start.vx, start.vy);
    CHECK((out.velocity - expected).norm() < 5e-4 * speed);
    CHECK(std::abs(out.contact_time() / row("contact_time") - 1.0) < 5e-4);
    CHECK(std::abs(out.tally.max_overlap / row("max_overlap") - 1.0) < 5e-4);
    stuck += row.text("slip_stops") == "1";
  }
  CHECK(stuck > 5);
}
