// Which impacts count as passages, for how long they pull, and what a visit is, against impacts
// followed step by step.
#include "engine/brake.hpp"
#include "tests/catch.hpp"
#include "tests/physics/impacts.hpp"

#include <cmath>
#include <numbers>

using namespace impacts;

namespace {

/// A grain that grazes a single wall grain at so many v_crit, v_crit for a contact that begins as
/// fast across.
struct Graze {
  Contact contact;
  double t_col;    ///< s, at the entry velocity
  double pulling;  ///< s, seen
};

Graze graze(const ContactModel& model, double speed_ratio, double steps) {
  const double c = chord(reach, impact_height);
  constexpr double typical_rate = 0.3;  // m/s; matters for laws that are not linear
  const double t_col = collision_time(model.normal, mass, typical_rate);
  const double v = speed_ratio * c / t_col;
  const double length = 64.0 * reach;
  State state = empty_box(length, length);
  state.walls = {{.line = 0.0, .radius = wall_radius, .count = 1}};
  state.time_step = resolving_time_step(t_col, impact_height, v, steps);
  const double upstream = -std::sqrt(1.002 * reach * reach - impact_height * impact_height);
  add_grain(state, grain(impact_height, upstream, 0.0, v));

  Simulation simulation(state, model, 1);
  Graze result{};
  while (simulation.state().tally.walls.ended == 0) {
    simulation.advance(1);
    const State& now = simulation.state();
    if (now.contacts.empty()) continue;
    result.contact = now.contacts.front();
    const double x = now.box.metres_x(now.grains.position[0].x),
                 y = now.box.metres_y(now.grains.position[0].y);
    const double outward =
        x * now.box.metres_x(now.grains.kick[0].x) + y * now.box.metres_y(now.grains.kick[0].y);
    if (outward < 0.0) result.pulling += now.time_step;
  }
  result.t_col = collision_time(model.normal, mass, result.contact.entry_rate);
  return result;
}

ContactModel with(const NormalLaw& normal) {
  ContactModel model = paper_model();
  model.normal = normal;
  return model;
}

}  // namespace

TEST_CASE("a graze far below v_crit is no passage, one far above is") {
  const NormalLaw normal = GENERATE(
      NormalLaw(LinearLaw{stiffness, 0.0}), NormalLaw(LinearLaw{stiffness, damping}),
      NormalLaw(LinearLaw{stiffness, 3.0 * damping}), NormalLaw(HertzKuwabaraKonoLaw{5e5, 3.3}),
      NormalLaw(PowerLaw{2e4, 1e-2, 1.2, 0.2, 1.1}),
      NormalLaw(EqualRestitutionLaw{{stiffness, 7.0}}));
  const double steps = GENERATE(50.0, 200.0);
  const auto passes = [&](double ratio) {
    return is_cut_short(graze(with(normal), ratio, steps).contact, with(normal), mass);
  };
  CHECK_FALSE(passes(0.1));
  CHECK_FALSE(passes(0.3));
  CHECK(passes(3.0));
  CHECK(passes(10.0));
}

TEST_CASE("for the linear law the border is at v_crit") {
  const double gamma = GENERATE(0.0, damping);
  const LinearLaw law{stiffness, gamma};
  CHECK_FALSE(is_cut_short(graze(with(law), 0.95, 200.0).contact, with(law), mass));
  CHECK(is_cut_short(graze(with(law), 1.1, 200.0).contact, with(law), mass));
}

TEST_CASE("a spring along a round surface lasts as long as the formula says") {
  // Without damping and friction; entry at the chord's angle, deflection beyond first order left.
  const double ratio = GENERATE(0.1, 0.3, 1.0, 3.0, 10.0);
  const Graze g = graze(frictionless(0.0), ratio, 500.0);
  const double expected = 2.0 / std::numbers::pi * std::atan(std::numbers::pi / (2.0 * ratio));
  CHECK(std::abs(g.contact.duration() / g.t_col / expected - 1.0) < 0.03);
}

TEST_CASE("the time for which a contact pulls is worked out well enough") {
  const double gamma = GENERATE(0.0, 0.3 * damping, damping);
  const double ratio = GENERATE(0.1, 1.0, 5.0);
  const ContactModel model = with(LinearLaw{stiffness, gamma});
  const Graze g = graze(model, ratio, 500.0);
  const double duration = g.contact.duration();
  CAPTURE(gamma, ratio, g.pulling / duration);
  CHECK(std::abs(pulling_time(g.contact, model, mass) - g.pulling) < 0.012 * duration);
}

TEST_CASE("a grain that comes from afar has not stuck before it arrives") {
  const double height = GENERATE(10e-3, 20e-3, 40e-3);  // m
  const ImpactSetup setup = wall_array(paper_model(), wall_collision_time());
  const ImpactResult result = follow(
      setup, {.x = height,
              .y = 0.0,
              .v_x = 0.1,
              .v_y = 20.0,
              .time_step = resolving_time_step(setup.collision_time, impact_height, 20.0, 50.0)});
  CHECK(result.end == ImpactEnd::away);
  CHECK(result.contacts >= 1.0);
}

TEST_CASE("a grain that is far too fast for any contact has gone through the wall") {
  const double v_x = GENERATE(1e3, 1e4, 3e4);  // m/s
  const ImpactSetup setup = wall_array(paper_model(), wall_collision_time());
  const ImpactResult result = follow(
      setup,
      {.x = 1.1 * reach, .y = 0.0, .v_x = v_x, .v_y = 1.0, .time_step = setup.collision_time / 50});
  CHECK(result.end == ImpactEnd::passed);
}

TEST_CASE("an impact on the wall array is one visit") {
  // Until the grain is away for good, by the scenario's own rule; then nothing comes any more.
  const double v_x = GENERATE(0.1, 0.3, 0.5);
  const double v_y = GENERATE(0.1, 0.5, 2.0, 5.0, 10.0, 20.0, 40.0);
  const ImpactSetup setup = wall_array(paper_model(), wall_collision_time());
  int followed = 0;
  for (double start = 0.0; start < 1.0; start += 0.25) {
    const Impact impact{.x = reach,
                        .y = start * spacing,
                        .v_x = v_x,
                        .v_y = v_y,
                        .time_step =
                            resolving_time_step(setup.collision_time, impact_height, v_y, 50.0)};
    const ImpactResult result = follow(setup, impact);
    if (result.end != ImpactEnd::away) continue;
    ++followed;

    State state = empty_box(64.0 * reach, 81.0 * spacing);
    state.walls = {{.line = 0.0, .radius = wall_radius, .count = 81}};
    state.time_step = impact.time_step;
    add_grain(state, grain(impact.x, impact.y, -v_x, v_y));
    const double longest_patience = 11.0 * spacing / std::hypot(v_x, v_y);
    const State after = advanced(
        state, paper_model(), result.steps + std::llround(longest_patience / impact.time_step) + 2);
    CAPTURE(v_x, v_y, start);
    const VisitTally& visits = after.tally.visits;
    CHECK(visits.visits() == 1);
    CHECK(static_cast<double>(visits.contacts) == result.contacts);
    CHECK(std::abs(visits.dv_y.value() - result.dv_y) < 1e-9 + 1e-6 * std::abs(result.dv_y));
    CHECK(std::abs(visits.dv_x.value() - result.dv_x) < 1e-9 + 1e-6 * std::abs(result.dv_x));
  }
  CHECK(followed > 0);
}
