// The inclined chute: what it is made of, what it refuses, and what the statics of a slope asks.
#include "engine/observables.hpp"
#include "engine/simulation.hpp"
#include "engine/strips.hpp"
#include "engine/time_blocks.hpp"
#include "io/checkpoint.hpp"
#include "tests/io/file_fixture.hpp"
#include "tests/scenarios/scenario_fixture.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

using namespace scenario_fixture;
using Catch::Matchers::WithinRel;

namespace {

constexpr double degree = std::numbers::pi / 180.0;

/// So inelastic and rough that it soon comes to rest where the slope lets it.
const std::string chute_yaml = R"(
scenario: inclined_chute
contact: {stiffness: 200 N/m, restitution: 0.3, friction: 0.6, slip: spring, slip_stiffness: 60 N/m}
grains: {rotation: disc, polydispersity: 0.1}
chute: {inclination: 10 degrees, length: 10 mm, layers: 6, height: 20 mm}
start: {axial_velocity: 0, random_velocity: 0.05 m/s}
run: {duration: 0.1 s}
)";

scenarios::Flow chute(const Overrides& overrides = {}) { return flow(chute_yaml, overrides); }

State after(const scenarios::Flow& start, double seconds) {
  Simulation simulation(start.state, start.model, 1);
  simulation.advance(std::llround(seconds / start.state.time_step));
  return simulation.state();
}

double average(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

TEST_CASE("a chute has a rough bottom, no lid, and gravity at its angle") {
  const State state = chute({"wall.spacing=1.3 mm"}).state;
  REQUIRE(state.walls.size() == 1);
  CHECK(state.walls[0].line == 0.0);
  CHECK(state.walls[0].count == 8);
  CHECK_THAT(state.gravity.x, WithinRel(-10.0 * std::cos(10.0 * degree), 1e-12));
  CHECK_THAT(state.gravity.y, WithinRel(10.0 * std::sin(10.0 * degree), 1e-12));
}

TEST_CASE("a tube can lean, and stands upright unless told so") {
  CHECK(tube().state.gravity.x == 0.0);
  CHECK(tube().state.gravity.y == 10.0);
  const Gravity leaning = tube({"tube.tilt=30 degrees"}).state.gravity;
  CHECK_THAT(leaning.x, WithinRel(-5.0, 1e-12));
  CHECK_THAT(leaning.y, WithinRel(5.0 * std::sqrt(3.0), 1e-12));
}

TEST_CASE("walls can be smooth, and have no grains then") {
  const State state = tube({"wall.surface=smooth"}).state;
  for (const WallLattice& wall : state.walls) CHECK(wall.smooth());
  CHECK(state.grains.size() == tube().state.grains.size());
  for (const Grain& g : grains_of(state)) {
    CHECK(g.x > g.radius - 1e-12);
    CHECK(g.x < 20e-3 - g.radius + 1e-12);
  }
  check_mentions(complaint(tube_yaml, {"wall.surface=smooth", "wall.spacing=1 mm"}),
                 {"wall.spacing", "wall.surface"});
}

TEST_CASE("there are as many layers as set, above the bottom, and nothing touches") {
  const double layers = GENERATE(0.5, 1.0, 6.0, 14.0);
  const auto start = chute({"chute.layers=" + std::to_string(layers), "chute.height=40 mm"});
  const State& state = start.state;
  double area = 0.0;
  for (const double radius : state.grains.radius) area += std::numbers::pi * radius * radius;
  const double grain = 0.25 * std::numbers::pi * 1e-6;
  CHECK(std::abs(area - layers * 10.0 * grain) < 0.7 * grain);
  for (const Grain& g : grains_of(state)) {
    CHECK(g.x > g.radius + state.walls[0].radius - 1e-12);
    CHECK(g.x < 40e-3 - g.radius);
  }
  CHECK(after(start, state.time_step).tally.grains.begun == 0);
}

TEST_CASE("layers are of the grains that there are, also if their sizes come from a file") {
  const file_fixture::ScratchDirectory directory;
  file_fixture::overwrite(directory / "half.csv", "diameter (mm)\n0.5\n");
  const auto start = chute({"grains.polydispersity=", "grains.size_distribution=file",
                            "grains.sizes_from=" + (directory / "half.csv").string()});
  CHECK(start.state.grains.size() == 6 * 20);  // 20 side by side over 10 mm
}

TEST_CASE("a chute of one layer can be shaken") {
  const std::vector<std::string> shaken = {"chute.layers=1", "wall.shake_amplitude=1 mm",
                                           "wall.shake_frequency=20 Hz",
                                           "wall.shake_angle=90 degrees"};
  CHECK(chute(shaken).state.grains.size() == chute({"chute.layers=1"}).state.grains.size());
}

TEST_CASE("what does not fit into a chute is refused") {
  check_mentions(complaint(chute_yaml, {"chute.layers=40"}),
                 {"chute.height", "too low", "fewer layers"});
  check_mentions(complaint(chute_yaml, {"chute.height=0.8 mm"}),
                 {"chute.height", "too low", "smaller grains"});
  check_mentions(complaint(chute_yaml, {"chute.length=3 mm"}),
                 {"chute.length", "too short", "four diameters"});
  check_mentions(complaint(chute_yaml, {"wall.spacing=11 mm"}), {"wall.spacing", "chute.length"});
  check_mentions(complaint(chute_yaml, {"chute.inclination=91 degrees"}), {"chute.inclination"});
  check_mentions(complaint(chute_yaml, {"chute.inclination=20"}), {"chute.inclination"});
}

TEST_CASE("a layer at rest on a slope is carried as statics asks, at every height") {
  // Above each height the weight of what lies there: the shear stress over the normal stress is the
  // tangent of the angle. y-momentum goes down, to smaller x.
  const double angle = GENERATE(5.0, 10.0);
  const auto start = chute({"chute.inclination=" + std::to_string(angle) + " degrees"});
  Simulation simulation(start.state, start.model, 1);
  simulation.advance(std::llround(1.0 / start.state.time_step));
  const Observables before = observe(simulation.state());
  CHECK(std::abs(before.mean_vy) < 1e-3);
  const Strips strips = Strips::of(start.state);
  TimeBlocks blocks(strips.columns());
  for (int sample = 0; sample < 200; ++sample) {
    simulation.advance(200);
    blocks.add(sum_over_strips(strips, simulation.state(), start.model, {}));
  }
  const auto stress = [&](std::size_t strip, StripSum contact) {
    return average(blocks.means(Strips::column(strip, contact), 0)) / strips.area();
  };
  const double weight = 10.0 * total_mass(start.state.grains) / start.state.box.length;
  // The lowest strip reaches into the first layer, whose weight its upper part does not carry.
  CHECK_THAT(stress(0, StripSum::contact_xx), WithinRel(weight * std::cos(angle * degree), 0.1));
  for (std::size_t strip = 0; strip < 4; ++strip) {
    const double normal = stress(strip, StripSum::contact_xx);
    CHECK(normal > 0.2 * weight);
    CHECK_THAT(-stress(strip, StripSum::contact_xy) / normal,
               WithinRel(std::tan(angle * degree), 0.01));
  }
  const Observables later = observe(simulation.state());
  const double braking =
      (later.impulse_y_of_wall[0] - before.impulse_y_of_wall[0]) / (later.time - before.time);
  CHECK_THAT(-braking, WithinRel(start.state.gravity.y * total_mass(start.state.grains), 0.01));
  const double pressing =
      (later.impulse_x_of_wall[0] - before.impulse_x_of_wall[0]) / (later.time - before.time);
  CHECK_THAT(pressing, WithinRel(-start.state.gravity.x * total_mass(start.state.grains), 0.01));
}

TEST_CASE("a steep chute flows, and its energy is accounted for") {
  const auto start = chute({"chute.inclination=30 degrees"});
  const State end = after(start, 0.3);
  const Observables o = observe(end);
  CHECK(o.mean_vy > 0.1);
  const double lost = o.energies.normal_loss + o.energies.friction_loss;
  CHECK(lost > 0.3 * o.energies.gravity_work);
  CHECK(std::abs(o.energies.residual) < 0.01 * o.energies.gravity_work);
}

TEST_CASE("a chute can be continued at another angle, but not with another height") {
  const file_fixture::ScratchDirectory directory;
  io::write_checkpoint(
      directory / io::checkpoint_name,
      {.state = after(chute(), 0.02), .settings = read(chute_yaml).effective_yaml(), .source = {}});
  const Overrides continued{"start=", "start.kind=continued",
                            "start.from=" + directory.path().string()};
  const auto with = [&](const std::string& change) {
    Overrides all = continued;
    all.push_back(change);
    return all;
  };
  const State steeper = chute(with("chute.inclination=25 degrees")).state;
  CHECK_THAT(steeper.gravity.y, WithinRel(10.0 * std::sin(25.0 * degree), 1e-12));
  check_mentions(complaint(chute_yaml, with("chute.height=30 mm")),
                 {"chute.height", "0.03", "0.02", "make both equal"});
}
