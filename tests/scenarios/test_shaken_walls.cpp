// Walls that shake: in which direction, how far, and where a run goes on.
#include "engine/encounter.hpp"
#include "engine/observables.hpp"
#include "engine/simulation.hpp"
#include "io/checkpoint.hpp"
#include "tests/io/file_fixture.hpp"
#include "tests/scenarios/scenario_fixture.hpp"

#include <cmath>

using namespace scenario_fixture;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

Overrides shaken(const Overrides& more) {
  Overrides all = {"wall.shake_amplitude=0.2 mm", "wall.shake_frequency=50"};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace

TEST_CASE("walls shake in the direction that they are told") {
  const WallMotion along = tube(shaken({})).state.walls[1].motion;
  CHECK(along.amplitude_x == 0.0);
  CHECK(along.amplitude_y == 0.2e-3);
  const WallMotion oblique = tube(shaken({"wall.shake_angle=-30 degrees"})).state.walls[1].motion;
  CHECK_THAT(oblique.amplitude_x, WithinRel(-0.1e-3, 1e-12));
  CHECK_THAT(oblique.amplitude_y, WithinRel(0.1e-3 * std::sqrt(3.0), 1e-12));
  const State across = tube(shaken({"wall.shake_angle=90 degrees"})).state;
  CHECK_THAT(across.walls[0].motion.amplitude_x, WithinRel(0.2e-3, 1e-12));
  CHECK_THAT(across.walls[0].motion.way(across.box, 5e-3).x, WithinRel(0.2e-3, 1e-9));
  CHECK(across.walls[0].motion.amplitude_y == 0.0);
}

TEST_CASE("grains find their places between walls that stand and move only afterwards") {
  const Overrides dense = {"grains.area_fraction=0.7", "grains.polydispersity=0.3"};
  for (const char* angle : {"0", "90 degrees"}) {
    Overrides moved = shaken(dense);
    moved.push_back(std::string("wall.shake_angle=") + angle);
    const State still = tube(dense).state, state = tube(moved).state;
    CHECK(state.grains.position == still.grains.position);
  }
}

TEST_CASE("walls that shake too far or too fast are refused") {
  const auto swing = [](const char* amplitude, const char* angle) {
    return complaint(tube_yaml, {"wall.shake_frequency=10", "tube.length=40 mm",
                                 std::string("wall.shake_amplitude=") + amplitude,
                                 std::string("wall.shake_angle=") + angle});
  };
  check_mentions(swing("11 mm", "0"), {"wall.shake_amplitude", "period of 0.04 m", "quarter"});
  check_mentions(swing("6 mm", "90 degrees"), {"wall.shake_amplitude", "width of 0.02 m"});
  CHECK(swing("6 mm", "0") == "accepted");
  check_mentions(complaint(tube_yaml, shaken({"wall.shake_frequency=1e8"})),
                 {"wall.shake_frequency", "too fast"});
  // Corrugated walls that run past their grains in a few steps
  check_mentions(complaint(tube_yaml, {"wall.shake_frequency=3e4", "wall.shake_amplitude=4 mm"}),
                 {"wall.shake_frequency", "in a time step"});
  CHECK(complaint(tube_yaml,
                  {"wall.shake_frequency=3e4", "wall.shake_amplitude=4 mm", "wall.surface=smooth"})
        == "accepted");
}

TEST_CASE("a shaking of which half is given is refused") {
  check_mentions(complaint(tube_yaml, {"wall.shake_amplitude=1 mm"}),
                 {"wall.shake_amplitude: has no effect", "give wall.shake_frequency, too"});
  check_mentions(complaint(tube_yaml, {"wall.shake_angle=90 degrees"}),
                 {"wall.shake_angle: has no effect", "give wall.shake_amplitude, too"});
  check_mentions(complaint(tube_yaml, {"wall.shake_frequency=50"}),
                 {"wall.shake_frequency: has no effect", "give wall.shake_amplitude, too"});
  CHECK(complaint(tube_yaml, shaken({"wall.shake_amplitude=0"})) == "accepted");
}

TEST_CASE("shaking that time steps do not resolve is refused") {
  const double dt = tube({}).state.time_step;
  const auto steps_per_period = [&](double steps) {
    return complaint(tube_yaml, {"wall.shake_amplitude=1 um",
                                 "wall.shake_frequency=" + std::to_string(1.0 / (steps * dt))});
  };
  CHECK(steps_per_period(20.3) == "accepted");
  check_mentions(steps_per_period(19.7), {"19.7 time steps per period"});
  check_mentions(steps_per_period(2.0), {"wall.shake_frequency", "2 time steps per period"});
}

TEST_CASE("rows in step with the shaking, which see it in few phases, are refused") {
  const auto every = [](const std::string& interval) {
    return complaint(tube_yaml, {"wall.shake_amplitude=1 um", "wall.shake_frequency=100",
                                 "run.duration=2 s", "output.interval=" + interval});
  };
  check_mentions(every("10 ms"), {"output.interval:", "only 1 phase of", "choose 0.0093 s"});
  check_mentions(every("30 ms"), {"output.interval:", "only 1 phase of"});
  check_mentions(every("5 ms"), {"only 2 phases of"});
  check_mentions(every("2.5 ms"), {"only 4 phases of"});
  for (const char* interval : {"10 ms", "15 ms", "20 ms", "30 ms", "70 ms", "90 ms"}) {
    const std::string refusal = every(interval), choose = "choose ";
    const auto begin = refusal.find(choose) + choose.size();
    CAPTURE(refusal);
    CHECK(every(refusal.substr(begin, refusal.find(", for example") - begin)) == "accepted");
  }
  for (const char* wandering : {"2 ms", "9.3 ms", "1 ms", "0.1 ms", "1.7 ms", "9.8 ms"})
    CHECK(every(wandering) == "accepted");
}

TEST_CASE("rows that may end long before they have seen other phases are refused") {
  const auto every = [](const std::string& interval, const Overrides& length) {
    Overrides all = {"wall.shake_amplitude=1 um", "wall.shake_frequency=100",
                     "run.duration=", "output.interval=" + interval};
    all.insert(all.end(), length.begin(), length.end());
    return complaint(tube_yaml, all);
  };
  // In 100 s rows 10.005 ms apart go through five periods; in the 125 with which the run may end,
  // through a sixteenth of one.
  const Overrides until = {"run.until.relative_error=5 %", "run.until.at_most=100 s"};
  CHECK(every("10.005 ms", {"run.duration=100 s"}) == "accepted");
  check_mentions(every("10.005 ms", until), {"output.interval:", "only 1 phase of"});
  CHECK(every("9.3 ms", until) == "accepted");
}

TEST_CASE("a tube that lies has no gravity along it") {
  const State state = tube({"tube.tilt=90 degrees"}).state;
  CHECK(state.gravity.y == 0.0);
  CHECK(state.gravity.x == -10.0);
}

TEST_CASE("shaken walls heat what is between them, as they are told to") {
  const auto start = tube({"wall.shake_amplitude=0.2 mm", "wall.shake_frequency=50", "gravity=0",
                           "start.axial_velocity=0", "start.random_velocity=0.05 m/s"});
  CHECK(start.state.walls[0].motion.amplitude_y == 0.2e-3);
  Simulation simulation(start.state, start.model, 1);
  simulation.advance(std::llround(0.2 / start.state.time_step));
  const Energies energies = observe(simulation.state()).energies;
  CHECK(energies.wall_work > 0.0);
  CHECK(std::abs(energies.residual)
        < 0.01 * (energies.wall_work + simulation.state().origin.energy));
}

TEST_CASE("a run between shaken walls goes on where they were") {
  const file_fixture::ScratchDirectory directory;
  const std::string angle = GENERATE("0", "90 degrees", "50 degrees");
  const double stopped = GENERATE(23e-3, 27e-3);  // s: the walls go there, or come back
  const auto start = tube(shaken({"wall.shake_angle=" + angle}));
  Simulation simulation(start.state, start.model, 1);
  simulation.advance(std::llround(stopped / start.state.time_step));
  const State& earlier = simulation.state();
  io::write_checkpoint(
      directory / io::checkpoint_name,
      {.state = earlier,
       .settings = read(tube_yaml, shaken({"wall.shake_angle=" + angle})).effective_yaml(),
       .source = {}});
  const Overrides continued = {"start.kind=continued", "start.from=" + directory.path().string(),
                               "wall.shake_angle=" + angle, "wall.shake_frequency=70"};
  const auto next = tube(shaken(continued));
  const StepUnits then(earlier), now(next.state);
  for (std::size_t wall : {0U, 1U}) {
    const auto off_by = [&](Fixed a, Fixed b, double quantum) {
      return std::abs(static_cast<double>(a - b)) * quantum;
    };
    const BodyMotion &is_now = now.walls[wall], &was_then = then.walls[wall];
    CHECK(off_by(is_now.position.x, was_then.position.x, start.state.box.quantum_x()) < 1e-15);
    CHECK(is_now.position.y == was_then.position.y);
    // They swing on in the direction that they had, as much faster as the frequency is higher.
    const WallMotion &before = earlier.walls[wall].motion, &after = next.state.walls[wall].motion;
    const double period = 1.0 / before.frequency;
    for (const double part : {-0.1, 0.1}) {
      const WallWay was = before.way(earlier.box, earlier.time() + part * period);
      const WallWay is = after.way(next.state.box, part * period * 50.0 / 70.0);
      CHECK_THAT(is.x, WithinAbs(was.x, 1e-12));
      CHECK_THAT(is.y, WithinAbs(was.y, 1e-12));
    }
    CHECK((was_then.u.x < 0) == (is_now.u.x < 0));
    CHECK((was_then.u.y < 0) == (is_now.u.y < 0));
  }
  if (angle == "0") return;
  Overrides as_far = shaken(continued);  // but for the last bit
  as_far.emplace_back("wall.shake_amplitude=0.4 mm");
  as_far.emplace_back("wall.shake_angle=30 degrees");
  if (angle == "90 degrees") CHECK(complaint(tube_yaml, as_far) == "accepted");
  Overrides other = shaken(continued);
  other.emplace_back("wall.shake_amplitude=0.3 mm");
  check_mentions(
      complaint(tube_yaml, other),
      {"wall.shake_amplitude", "shakes the walls across with amplitude", "to be continued with"});
}
