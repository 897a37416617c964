// The start of the tube from a file of grains: they are those of the file, move as they must, and
// what cannot be is told with its place.
#include "engine/closed_forms.hpp"
#include "engine/simulation.hpp"
#include "tests/io/file_fixture.hpp"
#include "tests/scenarios/scenario_fixture.hpp"

#include <cmath>
#include <numbers>

using namespace scenario_fixture;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using file_fixture::ScratchDirectory;

namespace {

const std::string head = "x (mm), y (mm), vx (m/s), vy (m/s), diameter (mm)\n";

/// A tube of 20 mm x 20 mm whose grains stand in a file.
class FileStart {
public:
  explicit FileStart(const std::string& csv) {
    file_fixture::overwrite(directory_ / "grains.csv", csv);
  }
  Overrides overrides(const Overrides& more = {}) const {
    Overrides all = {"start.kind=file", "start.from=" + (directory_ / "grains.csv").string()};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  State state(const Overrides& more = {}) const { return tube(overrides(more)).state; }
  std::string complaint(const Overrides& more = {}) const {
    return scenario_fixture::complaint(tube_yaml, overrides(more));
  }

private:
  ScratchDirectory directory_;
};

/// Rows of grains on a lattice, with unequal sizes and velocities.
std::string many_grains() {
  std::string csv = head;
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < 14; ++j)
      csv += std::to_string(1.6 + 1.5 * i) + "," + std::to_string(0.3 + 1.4 * j) + ","
             + std::to_string(std::sin(3.0 * i + j)) + "," + std::to_string(std::cos(i + 5.0 * j))
             + "," + std::to_string(0.8 + 0.04 * ((3 * i + j) % 12)) + "\n";
  return csv;
}

}  // namespace

TEST_CASE("the grains are those of the file") {
  const FileStart file(head + "5, 3, 0.5, -1, 1\n# the second\n10, 19.9, 0, 2, 0.8\n");
  const State state = file.state({"grains.mass=2 mg"});
  REQUIRE(state.grains.size() == 2);
  const Grain first = grain_at(state, 0), second = grain_at(state, 1);
  CHECK_THAT(first.x, WithinRel(5e-3, 1e-12));
  CHECK_THAT(first.y, WithinRel(3e-3, 1e-12));
  CHECK_THAT(first.vx, WithinRel(0.5, 1e-9));
  CHECK_THAT(first.vy, WithinRel(-1.0, 1e-9));
  CHECK(first.radius == 0.5e-3);
  CHECK(first.mass == 2e-6);
  CHECK_THAT(second.y, WithinRel(19.9e-3, 1e-12));
  CHECK_THAT(second.mass, WithinRel(2e-6 * 0.64, 1e-12));
}

TEST_CASE("masses of a file count, and the lightest pair sets the time step") {
  const FileStart file("mass (mg),diameter (mm),x (mm),y (mm),vx,vy\n4,1,5,5,0,0\n1,1,9,9,0,0\n");
  const State state = file.state();
  CHECK(grain_at(state, 0).mass == 4e-6);
  const double shortest = LinearContact{2000.0, 1e4, 0.5e-6}.collision_time();
  CHECK_THAT(state.time_step, WithinRel(shortest / 50.0, 1e-12));
}

TEST_CASE("spins whose energy or sum no sum would hold are refused") {
  // A fraction of a turn in the short steps of hard contacts, but 800 km/s at the rim; or, with
  // small grains, too much in all.
  struct Case {
    const char *row, *limit;
  };
  for (const Case& c :
       {Case{"2e8,8,5,5,0,0\n", "6.55e+07"}, Case{"2e11,1e-3,5,5,0,0\n", "6.87e+10"}}) {
    const FileStart file(std::string("spin (1/s),diameter (mm),x (mm),y (mm),vx,vy\n") + c.row);
    check_mentions(file.complaint({"grains.rotation=disc", "contact.stiffness=2e11", "gravity=0",
                                   "tube.length=40 mm"}),
                   {"start.from", "spins whose sum or energy", c.limit});
  }
}

TEST_CASE("grains that rotate may have spins in the file, others may not") {
  const FileStart file("spin (1/s),diameter (mm),x (mm),y (mm),vx,vy\n-30,1,5,5,0,0\n");
  CHECK_THAT(grain_at(file.state({"grains.rotation=disc"}), 0).spin, WithinRel(-30.0, 1e-9));
  check_mentions(file.complaint(),
                 {"grains.csv:2:1: spin: has no effect, as grains do not rotate"});
  const FileStart turns("spin (rpm),diameter (mm),x (mm),y (mm),vx,vy\n60,1,5,5,0,0\n");
  CHECK_THAT(grain_at(turns.state({"grains.rotation=disc"}), 0).spin,
             WithinRel(2.0 * std::numbers::pi, 1e-9));
}

TEST_CASE("a file of masses does not leave open which grain has the restitution") {
  const std::string masses = "mass (mg),diameter (mm),x (mm),y (mm),vx,vy\n5,1,5,5,0,0\n";
  const FileStart file(masses);
  const Overrides restitution = {"contact.damping=", "contact.restitution=0.9"};
  const auto with = [&](const std::string& more) {
    Overrides all = restitution;
    all.push_back(more);
    return file.complaint(all);
  };
  check_mentions(file.complaint(restitution), {"contact.restitution: of which grain?",
                                               "give the mass of the grain", "grains.mass"});
  CHECK(with("grains.mass=5 mg") == "accepted");
  CHECK(with("contact.restitution_of=all") == "accepted");
}

TEST_CASE("grains of a file that do not fit are blamed on the file") {
  const FileStart file("x (mm), y (mm), vx (m/s), vy (m/s), diameter\n5, 3, 0.5, -1, 1\n");
  check_mentions(file.complaint({"grains.diameter=1 mm"}),
                 {"start.from: the periodic tube is too short", "as in 'diameter (mm)'"});
}

TEST_CASE("a grain from a file falls on its parabola") {
  const FileStart file(head + "10, 3, 0.4, 1, 1\n");
  const auto start = tube(file.overrides({"gravity=9.81 m/s^2"}));
  Simulation simulation(start.state, start.model, 1);
  simulation.advance(4000);
  const double t = simulation.state().time();
  const Grain grain = grain_at(simulation.state(), 0);
  const double y = std::fmod(3e-3 + 1.0 * t + 0.5 * 9.81 * t * t, 20e-3);
  CHECK_THAT(grain.x, WithinAbs(10e-3 + 0.4 * t, 1e-12));
  CHECK_THAT(grain.y, WithinAbs(y, 1e-10));
  CHECK_THAT(grain.vy, WithinAbs(1.0 + 9.81 * t, 1e-9));
}

TEST_CASE("grains from a file go the same plainly and by windows") {
  const FileStart file(many_grains());
  const auto start = tube(file.overrides());
  const auto hash = [&](Stepping stepping, int threads) {
    Simulation simulation(start.state, start.model, threads, stepping);
    simulation.advance(2000);
    CHECK(simulation.state().tally.grains.begun > 20);
    CHECK(simulation.state().tally.walls.begun > 5);
    return state_hash(simulation.state());
  };
  const auto plain = hash(Stepping::plain, 1);
  CHECK(hash(Stepping::windows, 1) == plain);
  CHECK(hash(Stepping::windows, 2) == plain);
}

TEST_CASE("settings of grains at random places have no effect on those of a file") {
  const FileStart file(head + "10, 3, 0, 1, 1\n");
  for (const std::string setting :
       {"grains.area_fraction=0.3", "grains.polydispersity=0.1", "start.axial_velocity=1"}) {
    CAPTURE(setting);
    check_mentions(complaint(tube_yaml, file.overrides({setting})),
                   {"has no effect when start.kind is file"});
  }
}

TEST_CASE("grains that cannot stand where they are are told with file, line and column") {
  const auto complaint_of = [](const std::string& rows) {
    return FileStart(head + rows).complaint();
  };
  check_mentions(complaint_of("5, 3, 0, 0, 1\n5.1, 3.9, 0, 0, 1\n"),
                 {"grains.csv:3:1: x: overlaps the grain in line 2 by 9.45e-05 m; move one"});
  check_mentions(complaint_of("5, 0.2, 0, 0, 1\n9, 9, 0, 0, 1\n5, 19.5, 0, 0, 1\n"),
                 {"grains.csv:4:1: x: overlaps the grain in line 2 by 0.0003 m"});
  check_mentions(
      complaint_of("5, 3, 0, 0, 1\n 20.5, 3, 0, 0, 1\n"),
      {"grains.csv:3:2: x: 0.0205 m is outside of the tube; choose it from 0 to 0.02 m"});
  check_mentions(complaint_of("5, -1, 0, 0, 1\n"), {"grains.csv:2:4: y: -0.001 m is outside"});
  check_mentions(complaint_of("0.5, 0, 0, 0, 1\n"),
                 {"grains.csv:2:1: x: stands 0.00033 m deep in a wall grain"});
  check_mentions(complaint_of("5, nan, 0, 0, 1\n"), {"grains.csv:2:4: y: 'nan' is not a number"});
  check_mentions(complaint_of("5, 3, 0, 0, 0\n"), {"grains.csv:2:13: diameter: is not above 0"});
  check_mentions(complaint_of("5, 3, 0, 0\n"), {"grains.csv:2:10: has 4 cells"});
  check_mentions(complaint_of(""), {"grains.csv: has no rows"});
  check_mentions(FileStart("x (mm), y (mm), vx, vy\n1,1,1,1\n").complaint(),
                 {"grains.csv:1:1: diameter: is missing"});
  check_mentions(FileStart(head + "10, 3, 0, 0, 6\n").complaint(), {"tube.length", "too short"});
  check_mentions(complaint(tube_yaml, {"start.kind=file"}), {"start.from: is missing"});
  check_mentions(complaint(tube_yaml, {"start.kind=file", "start.from=nowhere.csv"}),
                 {"start.from: cannot be read", "nowhere.csv"});
}

TEST_CASE("grains that touch, as well as a file can tell, do not overlap") {
  CHECK(FileStart(head + "5, 3, 0, 0, 1\n6, 3, 0, 0, 1\n5, 2, 0, 0, 1\n").complaint()
        == "accepted");
}
