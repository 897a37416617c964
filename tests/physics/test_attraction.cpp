// The end of a contact, where the damping of eq. (1) pulls: kept as the equation says, or clipped.
#include "engine/closed_forms.hpp"
#include "tests/catch.hpp"
#include "tests/physics/collisions.hpp"

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

}  // namespace

TEST_CASE("kept attraction pulls at the end of a contact, as eq. (1) says") {
  const Kicks kicks = kicks_of_a_head_on_contact(Attraction::keep);
  // At the very end the force is -gamma m e v; the largest, after two fifths of the contact, is
  // 0.87 sqrt(k m) v: a ratio of 0.180. The last kick stands for 0.5 to 1.5 steps of damping.
  const double ratio =
      static_cast<double>(kicks.strongest_pull) / static_cast<double>(kicks.strongest_push);
  CHECK(ratio > 0.5 * 0.180);
  CHECK(ratio < 1.5 * 0.180);
}

TEST_CASE("clipped attraction never pulls") {
  const Kicks kicks = kicks_of_a_head_on_contact(Attraction::clip);
  CHECK(kicks.strongest_pull == 0);
  CHECK(kicks.strongest_push > 0);
}
