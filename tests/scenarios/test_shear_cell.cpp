// The shear cell: what it is made of, where its energy and momentum go, and the kinetic theory of
// Jenkins and Richman, Phys. Fluids 28, 3485 (1985).
#include "engine/encounter.hpp"
#include "engine/observables.hpp"
#include "engine/simulation.hpp"
#include "engine/strips.hpp"
#include "engine/time_blocks.hpp"
#include "engine/tube_profiles.hpp"
#include "io/checkpoint.hpp"
#include "tests/io/file_fixture.hpp"
#include "tests/scenarios/scenario_fixture.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string_view>

using namespace scenario_fixture;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

using std::numbers::pi;

/// Walls so rough that hardly a grain slips.
const std::string cell_yaml = R"(
scenario: shear_cell
contact: {stiffness: 5000 N/m, restitution: 0.98, restitution_of: grains, friction: 0}
grains: {polydispersity: 0, area_fraction: 0.4}
wall: {grain_diameter: 1 mm, spacing: 1.4 mm}
cell: {width: 20 mm, length: 14 mm, velocity: 1 m/s}
start: {random_velocity: 0.1 m/s}
run: {duration: 1 s}
)";

scenarios::Flow cell(const Overrides& overrides = {}) { return flow(cell_yaml, overrides); }

State after_a_while(const scenarios::Flow& start) {
  Simulation simulation(start.state, start.model, 1);
  simulation.advance(1000);
  return simulation.state();
}

/// Means over the core of a cell in its steady state; per area where that matters.
struct Core {
  double shear_rate;   // 1/s
  double temperature;  // (m/s)^2
  double area_fraction;
  double pressure;  // N/m
};

/// By the sums of strips i <= s < j.
class Sheared {
public:
  explicit Sheared(const scenarios::Flow& start, int samples = 40'000)
      : simulation_(start.state, start.model, 1),
        strips_(Strips::of(start.state)),
        blocks_(strips_.columns()) {
    const auto steps = [&](double t) { return std::llround(t / start.state.time_step); };
    simulation_.advance(steps(0.3));
    before_ = observe(simulation_.state());
    for (int sample = 0; sample < samples; ++sample) {
      simulation_.advance(steps(0.2e-3));
      blocks_.add(sum_over_strips(strips_, simulation_.state(), start.model, {}));
    }
    after_ = observe(simulation_.state());
  }

  const Observables& before() const { return before_; }
  const Observables& after() const { return after_; }
  const Strips& strips() const { return strips_; }

  double mean(std::size_t strip, StripSum sum) const {
    const auto blocks = blocks_.means(Strips::column(strip, sum), 0);
    return std::accumulate(blocks.begin(), blocks.end(), 0.0) / static_cast<double>(blocks.size());
  }
  double velocity(std::size_t strip) const {
    return mean(strip, StripSum::vy) / mean(strip, StripSum::grains);
  }
  double shear_stress(std::size_t strip) const {
    return (mean(strip, StripSum::mass_vx_w) + mean(strip, StripSum::contact_xy)) / strips_.area();
  }

  Estimate profile(std::string_view name, const Zone& zone) const {
    const auto profiles = tube_profiles(blocks_, strips_, {zone}, 0);
    return std::ranges::find(profiles, name, &TubeProfile::name)->zones[0];
  }
  double temperature(std::string_view name, std::size_t strip) const {
    return profile(name, {strip}).value;
  }

  Core core() const {
    const std::size_t low = strips_.count / 4, high = strips_.count - low;
    Core core{};
    for (std::size_t s = low; s < high; ++s) {
      core.temperature += 0.5 * (temperature("temperature_x", s) + temperature("temperature_y", s));
      core.area_fraction += mean(s, StripSum::area) / strips_.area();
      core.pressure +=
          (mean(s, StripSum::mass_vx2) + mean(s, StripSum::contact_xx)) / strips_.area();
    }
    const auto n = static_cast<double>(high - low);
    for (double* value : {&core.temperature, &core.area_fraction, &core.pressure}) *value /= n;
    core.shear_rate = (velocity(high - 1) - velocity(low)) / ((n - 1.0) * strips_.width);
    return core;
  }

private:
  Simulation simulation_;
  Strips strips_;
  TimeBlocks blocks_;
  Observables before_, after_;
};

const Sheared& sheared() {
  static const Sheared the_cell(cell());
  return the_cell;
}

/// N/m, mean force along y of a wall on the grains, per length.
double wall_force(std::size_t wall) {
  const Observables &before = sheared().before(), &after = sheared().after();
  return (after.impulse_y_of_wall[wall] - before.impulse_y_of_wall[wall])
         / ((after.time - before.time) * sheared().strips().length);
}

}  // namespace

TEST_CASE(
    "the walls of a shear cell move past each other, and the grains begin as they will flow") {
  const State state = cell({"start.random_velocity=0"}).state;
  REQUIRE(state.walls.size() == 2);
  CHECK(state.walls[0].motion.velocity == -0.5);
  CHECK(state.walls[1].motion.velocity == 0.5);
  CHECK(state.gravity.y == 0.0);
  for (const Grain& g : grains_of(state)) CHECK_THAT(g.vy, WithinAbs(50.0 * g.x - 0.5, 1e-9));
}

TEST_CASE("what does not fit into a shear cell is refused") {
  check_mentions(complaint(cell_yaml, {"cell.width=1.5 mm"}), {"cell.width", "too narrow"});
  check_mentions(complaint(cell_yaml, {"cell.length=3 mm"}), {"cell.length", "too short"});
  check_mentions(complaint(cell_yaml, {"cell.velocity=1e5 m/s"}), {"cell.velocity", "too fast"});
  // Half of the spacing, and all of it, in a step
  const double per_step = 2.0 * 1.4e-3 / cell().state.time_step;
  for (const double part : {0.06, 0.5, 1.0})
    check_mentions(complaint(cell_yaml, {"cell.velocity=" + std::to_string(part * per_step)}),
                   {"cell.velocity", "in a time step", "run.steps_per_collision"});
  CHECK(complaint(cell_yaml, {"cell.velocity=" + std::to_string(0.04 * per_step)}) == "accepted");
}

TEST_CASE("in a sheared cell collisions take what the walls put in") {
  const Energies a = sheared().before().energies, b = sheared().after().energies;
  const double work = b.wall_work - a.wall_work;
  const double lost = b.normal_loss - a.normal_loss + b.friction_loss - a.friction_loss;
  CHECK(work > 10.0 * b.kinetic);
  CHECK(std::abs(lost - (work - (b.kinetic - a.kinetic))) < 5e-3 * work);
  CHECK(std::abs(lost - work) < 0.05 * work);
}

TEST_CASE("the shear stress is the same everywhere, and is the force of the walls") {
  CHECK_THAT(-wall_force(0), WithinRel(wall_force(1), 0.03));
  // In thirds of the width: single strips scatter by a third.
  for (std::size_t begin : {1U, 7U, 13U}) {
    double stress = 0.0;
    for (std::size_t strip = begin; strip < begin + 6; ++strip)
      stress -= sheared().shear_stress(strip) / 6.0;
    CHECK_THAT(stress, WithinRel(wall_force(1), 0.2));
  }
}

TEST_CASE("temperature and stresses of a sheared cell are those of the kinetic theory") {
  // Enskog's for discs of diameter d and mass m, nearly elastic. Per area: mass rho, dissipation
  // (4 / (pi^(1/2) d)) rho nu g0 (1 - e^2) T^(3/2); T is that of one component, per mass.
  const Core core = sheared().core();
  const double d = 1e-3, m = 1e-6, e = 0.98, nu = core.area_fraction;
  const double rho = m * nu / (0.25 * pi * d * d),
               g0 = (1.0 - 7.0 * nu / 16.0) / std::pow(1.0 - nu, 2);
  const double viscosity_per_root =
      1.022 / (2.0 * d) * m / std::sqrt(pi) * (1.0 / g0 + 2.0 * nu + 0.8729 * 4.0 * nu * nu * g0);
  const double loss_per_root = 4.0 / (std::sqrt(pi) * d) * rho * nu * g0 * (1.0 - e * e);
  const double temperature = viscosity_per_root * core.shear_rate * core.shear_rate / loss_per_root;
  const double t = core.temperature;
  CAPTURE(core.shear_rate, core.temperature, nu, core.pressure);
  // For smaller e the theory, of first order in the shear rate, is too hot: docs/flows.md.
  CHECK_THAT(t, WithinRel(temperature, 0.1));
  CHECK_THAT(core.pressure, WithinRel(rho * t * (1.0 + (1.0 + e) * nu * g0), 0.05));
  CHECK_THAT(wall_force(1), WithinRel(viscosity_per_root * std::sqrt(t) * core.shear_rate, 0.1));
}

TEST_CASE("grains that turn in a sheared cell turn with the flow") {
  // Where nothing varies but the velocity, no torque is left if grains have half the vorticity, or
  // some per cent less, as the stress is not isotropic.
  const Sheared turning(cell({"contact.friction=0.5", "grains.rotation=disc"}), 20'000);
  const Estimate spin = turning.profile("mean_spin", core_of(turning.strips()));
  const double half_of_vorticity = 0.5 * turning.core().shear_rate;
  CAPTURE(spin.value, spin.error, half_of_vorticity);
  CHECK(spin.error < 0.1 * half_of_vorticity);
  CHECK(std::abs(spin.value - half_of_vorticity) < 3.0 * spin.error);
}

TEST_CASE("a sheared cell goes on where it was, with walls that have moved") {
  const file_fixture::ScratchDirectory directory;
  Simulation simulation(cell().state, cell().model, 1);
  simulation.advance(30'000);
  while (simulation.state().contacts.empty()) simulation.advance(1);
  const State earlier = simulation.state();
  io::write_checkpoint(
      directory / io::checkpoint_name,
      {.state = earlier, .settings = read(cell_yaml).effective_yaml(), .source = {}});
  const auto next = cell({"start=", "start.kind=continued",
                          "start.from=" + directory.path().string(), "cell.velocity=2 m/s"});
  CHECK(next.state.walls[1].motion.velocity == 1.0);
  const StepUnits then(earlier), now(next.state);
  for (std::size_t wall : {0U, 1U})
    CHECK(now.walls[wall].position.y == then.walls[wall].position.y);
  CHECK(next.state.contacts.size() == earlier.contacts.size());
  CHECK_NOTHROW(after_a_while(next));
}

TEST_CASE("rows in step with wall grains that pass each other are refused") {
  const auto with = [](const Overrides& overrides) { return complaint(cell_yaml, overrides); };
  const std::string every = "output.interval=";
  // A wall grain passes the next one 1.4 ms after the last.
  check_mentions(with({every + "1.4 ms"}), {"output.interval:", "only 1 phase of the wall grains"});
  check_mentions(with({every + "0.7 ms"}), {"only 2 phases"});
  CHECK(with({every + "1 ms"}) == "accepted");
  CHECK(with({every + "0.35 ms"}) == "accepted");  // four phases
  CHECK(with({every + "1.4 ms", "wall=", "wall.surface=smooth"}) == "accepted");
  CHECK(with({every + "1.4 ms", "cell.velocity=0"}) == "accepted");
}
