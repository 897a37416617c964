// Grains that friction holds against gravity: a plug in a narrow tube.
#include "engine/observables.hpp"
#include "engine/simulation.hpp"
#include "tests/scenarios/scenario_fixture.hpp"

#include <cmath>

using namespace scenario_fixture;

namespace {

const std::string plug_yaml = R"(
scenario: periodic_tube
contact: {stiffness: 2000 N/m, restitution: 0.3, friction: 2}
grains: {area_fraction: 0.6}
tube: {width: 2.5 mm, length: 8 mm}
start: {axial_velocity: 0.1 m/s, random_velocity: 0.05 m/s}
run: {duration: 0.1 s}
)";

}  // namespace

TEST_CASE("the energy of a plug is accounted for, though friction turns from step to step") {
  const scenarios::Flow plug = flow(plug_yaml);
  Simulation simulation(plug.state, plug.model, 1);
  simulation.advance(std::llround(0.05 / plug.state.time_step));
  const Observables held = observe(simulation.state());
  CHECK(std::abs(held.mean_vy) < 1e-3);  // free fall would make it 0.6 m/s
  const Energies e = held.energies;
  CHECK(e.friction_loss > 0.2 * (e.normal_loss + e.friction_loss));
  CHECK(std::abs(e.residual) < 0.005 * (e.normal_loss + e.friction_loss));
}
