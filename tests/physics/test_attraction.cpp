// The end of a contact, where the damping of eq. (1) pulls: kept as the equation says, or clipped.
#include "engine/closed_forms.hpp"
#include "tests/catch.hpp"
#include "tests/physics/collisions.hpp"

#include <limits>

using namespace collisions;

namespace {

struct Kicks {
  Fixed strongest_pull = 0,
        strongest_push = 0;  // quanta; the wall is to the left, so a push is positive
};

Kicks kicks_of_a_head_on_contact(Attraction attraction) {
  ContactModel model = frictionless(damping);
  model.attraction = attraction;
  State state = open_space(LinearContact{stiffness, damping, mass}.collision_time() / 50.0);
  state.walls = {{.line = 0.0, .radius = wall_radius, .count = 1}};
  add_grain(state, grain(0.84e-3, 0.0, -1.0, 0.0));
  Simulation simulation(state, model, 1);
  Kicks kicks;
  while (simulation.state().tally.walls.ended == 0) {
    simulation.advance(1);
    const Fixed kick = simulation.state().grains.kick[0].x;
    kicks.strongest_pull = std::max(kicks.strongest_pull, -kick);
    kicks.strongest_push = std::max(kicks.strongest_push, kick);
  }
  return kicks;
}

double restitution(Attraction attraction) {
  ContactModel model = frictionless(damping);
  model.attraction = attraction;
  return head_on({.mass_1 = mass,
                  .mass_2 = std::numeric_limits<double>::infinity(),
                  .speed = 1.0,
                  .dt = 1e-7,
                  .phase = 0.5},
                 model)
      .restitution;
}

}  // namespace

TEST_CASE("kept attraction pulls at the end of a contact, as eq. (1) says") {
  const Kicks kicks = kicks_of_a_head_on_contact(Attraction::keep);
  // At the very end the force is -gamma m e v; at the largest overlap some sqrt(k m) v.
  const double ratio =
      static_cast<double>(kicks.strongest_pull) / static_cast<double>(kicks.strongest_push);
  CHECK(ratio > 0.05);
  CHECK(ratio < 0.7);
}

TEST_CASE("clipped attraction never pulls") {
  const Kicks kicks = kicks_of_a_head_on_contact(Attraction::clip);
  CHECK(kicks.strongest_pull == 0);
  CHECK(kicks.strongest_push > 0);
}

TEST_CASE("clipping gives a contact more restitution") {
  // 0.7023 and 0.7202 by the independent integrator (head_on.csv)
  CHECK(std::abs(restitution(Attraction::keep) - 0.702256) < 1e-4);
  CHECK(std::abs(restitution(Attraction::clip) - 0.720186) < 1e-4);
}
