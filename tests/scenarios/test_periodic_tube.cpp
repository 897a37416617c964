// The tube besides its packing: velocities, walls, time step, seeds, and what it refuses.
#include "tests/scenarios/scenario_fixture.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

using namespace scenario_fixture;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

struct Velocity {
  double x = 0.0, y = 0.0;  // m/s
};

Velocity of_centre_of_mass(const std::vector<Grain>& grains) {
  Velocity momentum;
  double mass = 0.0;
  for (const Grain& grain : grains) {
    momentum.x += grain.mass * grain.vx;
    momentum.y += grain.mass * grain.vy;
    mass += grain.mass;
  }
  return {momentum.x / mass, momentum.y / mass};
}

/// m/s, root mean square of each component of the velocities in the frame of the centre of mass.
Velocity root_mean_square(const std::vector<Grain>& grains) {
  const Velocity centre = of_centre_of_mass(grains);
  Velocity squares;
  for (const Grain& grain : grains) {
    squares.x += (grain.vx - centre.x) * (grain.vx - centre.x);
    squares.y += (grain.vy - centre.y) * (grain.vy - centre.y);
  }
  const auto n = static_cast<double>(grains.size());
  return {std::sqrt(squares.x / n), std::sqrt(squares.y / n)};
}

/// s, eq. (4) of the paper.
double collision_time(double k_n, double gamma_n, double reduced_mass) {
  return std::numbers::pi / std::sqrt(k_n / reduced_mass - 0.25 * gamma_n * gamma_n);
}

}  // namespace

TEST_CASE("the centre of mass starts with the velocity set, and the random momenta cancel") {
  const Velocity centre = of_centre_of_mass(
      grains_of(tube({"start.axial_velocity=7.5 m/s", "start.random_velocity=2 m/s"}).state));
  CHECK_THAT(centre.x, WithinAbs(0.0, 1e-9));
  CHECK_THAT(centre.y, WithinAbs(7.5, 1e-9));
}

TEST_CASE("the random velocities have the size set") {
  const Velocity rms = root_mean_square(
      grains_of(tube({"start.random_velocity=2 m/s", "tube.length=100 mm"}).state));
  CHECK_THAT(std::sqrt(0.5 * (rms.x * rms.x + rms.y * rms.y)), WithinAbs(2.0, 1e-9));
  CHECK_THAT(rms.x, WithinRel(2.0, 0.1));
  CHECK_THAT(rms.y, WithinRel(2.0, 0.1));
}

TEST_CASE("without random velocity all grains start with the same one, upwards too") {
  const State state = tube({"start.axial_velocity=-3 m/s", "start.random_velocity=0"}).state;
  for (const Grain& grain : grains_of(state)) {
    CHECK_THAT(grain.vx, WithinAbs(0.0, 1e-9));
    CHECK_THAT(grain.vy, WithinAbs(-3.0, 1e-9));
  }
}

TEST_CASE("a single grain starts with the axial velocity") {
  for (int seed = 1; seed <= 40; ++seed) {
    const State state = tube({"grains.area_fraction=0.001", "seed=" + std::to_string(seed)}).state;
    REQUIRE(state.grains.size() == 1);
    CHECK_THAT(grain_at(state, 0).vx, WithinAbs(0.0, 1e-9));
    CHECK_THAT(grain_at(state, 0).vy, WithinAbs(1.0, 1e-9));
  }
}

TEST_CASE("a time step so short that gravity is rounded is refused") {
  const auto steps = [](const char* number) {
    return complaint(tube_yaml, {std::string("run.steps_per_collision=") + number});
  };
  CHECK(steps("20000") == "accepted");
  check_mentions(steps("2000000"),
                 {"run.steps_per_collision: ", "gravity along an axis would be wrong"});
  CHECK(complaint(tube_yaml, {"gravity=1e-6"}) == "accepted");
  check_mentions(complaint(tube_yaml, {"gravity=1e-9"}),
                 {"gravity: ", "would be wrong", "gravity 0 or a stronger one"});
  CHECK(complaint(tube_yaml, {"run.steps_per_collision=2000000", "gravity=0"}) == "accepted");
}

TEST_CASE("the small component of gravity that drives a flow is not rounded away") {
  // A quantum of y in a tube of 10 m and a step of 0.03 microseconds: 6e-4 m/s^2.
  const auto at = [](const char* tilt) {
    return complaint(tube_yaml,
                     {std::string("tube.tilt=") + tilt, "tube.length=10 m", "tube.width=3 mm",
                      "grains.area_fraction=0.01", "contact.stiffness=2e6"});
  };
  CHECK(at("0 degrees") == "accepted");
  CHECK(at("90 degrees") == "accepted");
  check_mentions(at("89.9 degrees"), {"gravity along an axis would be wrong by"});
  check_mentions(at("89.999 degrees"), {"gravity along an axis would be wrong by 1e+02 %"});
}

TEST_CASE("the same seed gives the same state, another seed another one") {
  const std::string fraction = GENERATE("0.55", "0.8");  // on a lattice, and pushed apart
  const auto hash = [&](const std::string& seed) {
    return state_hash(tube({"seed=" + seed, "grains.area_fraction=" + fraction}).state);
  };
  CHECK(hash("1") == hash("1"));
  const std::set<std::uint64_t> hashes = {hash("0"), hash("1"), hash("2"),
                                          hash("9223372036854775807")};
  CHECK(hashes.size() == 4);
}

TEST_CASE("grains that are too fast are told by the fastest one") {
  // Random velocities are those of all grains together; single ones have several times as much.
  const auto with = [](double velocity) {
    return complaint(tube_yaml, {"start.random_velocity=" + std::to_string(velocity)});
  };
  const std::string refusal = with(1e4), said = "the fastest grain, now ", limit = "stays below ";
  check_mentions(refusal, {"start.random_velocity", "too fast", said, limit});
  const auto number_after = [&](const std::string& words) {
    return std::stod(refusal.substr(refusal.find(words) + words.size()));
  };
  const double part = number_after(limit) / number_after(said);
  CHECK(part < 1.0);
  CHECK(with(0.98 * part * 1e4) == "accepted");
  CHECK(with(1.02 * part * 1e4) != "accepted");
}

TEST_CASE("a seed decides about sizes, places and velocities") {
  const State a = tube({"seed=1"}).state, b = tube({"seed=2"}).state;
  const auto n = std::min(a.grains.size(), b.grains.size());
  std::size_t same_radius = 0, same_velocity = 0, same_place = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (a.grains.radius[i] == b.grains.radius[i]) ++same_radius;
    if (a.grains.u[i].x == b.grains.u[i].x) ++same_velocity;
    if (a.grains.position[i].x == b.grains.position[i].x
        && a.grains.position[i].y == b.grains.position[i].y)
      ++same_place;
  }
  CHECK(same_radius == 0);
  CHECK(same_velocity == 0);
  CHECK(same_place < n / 2);  // of the lattice, which may be the same
}

TEST_CASE("the spacing of the wall grains is adjusted so that a whole number fits") {
  struct Case {
    const char* length;
    std::int64_t count;
  };
  const auto [length, count] = GENERATE(Case{"20 mm", 17}, Case{"12 mm", 10}, Case{"10 mm", 8},
                                        Case{"5 mm", 4}, Case{"100 mm", 83});
  const State state = tube({std::string("tube.length=") + length}).state;
  REQUIRE(state.walls.size() == 2);
  CHECK(state.walls[0].line == 0.0);
  CHECK(state.walls[1].line == state.box.width);
  for (const WallLattice& wall : state.walls) {
    CHECK(wall.radius == 0.33e-3);
    CHECK(wall.count == count);
  }
}

TEST_CASE("the time step resolves the shortest contact: that of two of the lightest grains") {
  const State state = tube({"run.steps_per_collision=40"}).state;
  const double lightest = *std::min_element(state.grains.mass.begin(), state.grains.mass.end());
  const double shortest = collision_time(2000.0, 1e4, 0.5 * lightest);
  CHECK_THAT(state.time_step, WithinRel(shortest / 40.0, 1e-12));
}

TEST_CASE("a tube that is too narrow for its grains is refused, with the width it takes") {
  check_mentions(complaint(tube_yaml, {"tube.width=1.5 mm"}),
                 {"--set tube.width=1.5 mm", "tube.width:", "too narrow", "0.00171"});
  check_mentions(complaint(tube_yaml, {"tube.width=0.5 mm"}), {"tube.width:", "0.00171"});
  CHECK(complaint(tube_yaml, {"tube.width=1.72 mm", "grains.area_fraction=0.2"}) == "accepted");
  // A wall grain without its unit, in a tube that is wide enough for it.
  check_mentions(complaint(tube_yaml, {"wall.grain_diameter=0.66", "tube.width=2 m"}),
                 {"wall.grain_diameter: too large", "at most 0.0089", "'0.66 mm'"});
  // The key that was given is blamed.
  check_mentions(complaint(tube_yaml, {"grains.diameter=1 m", "tube.width=", "tube.length="}),
                 {"grains.diameter: the periodic tube is too short", "smaller grains"});
  check_mentions(complaint(tube_yaml, {"grains.diameter=1"}),
                 {"grains.diameter: the periodic tube is too short", "is a unit forgotten"});
}

TEST_CASE("a tube that is too short for its grains is refused, with the length it takes") {
  check_mentions(complaint(tube_yaml, {"tube.length=4 mm"}),
                 {"--set tube.length=4 mm", "tube.length:", "too short", "0.0042"});
  CHECK(complaint(tube_yaml, {"tube.length=4.2 mm"}) == "accepted");
}

TEST_CASE("wall grains farther apart than the tube is long are refused") {
  check_mentions(complaint(tube_yaml, {"wall.spacing=21 mm"}),
                 {"--set wall.spacing=21 mm", "wall.spacing:", "tube.length"});
}

TEST_CASE("an area fraction that no packing reaches is refused") {
  check_mentions(complaint(tube_yaml, {"grains.area_fraction=0.9"}),
                 {"grains.area_fraction:", "0.876", "unequal size"});
}

TEST_CASE("an area fraction for which no start is found is refused") {
  check_mentions(complaint(tube_yaml, {"grains.area_fraction=0.8", "grains.polydispersity=0.3",
                                       "tube.width=6 mm", "tube.length=6 mm"}),
                 {"grains.area_fraction:", "smaller fraction"});
}
