// The start from the end of another run: nothing moves, nothing is lost, and with the same settings
// it is the run going on.
#include "engine/observables.hpp"
#include "engine/simulation.hpp"
#include "io/checkpoint.hpp"
#include "io/durable_file.hpp"
#include "scenarios/continued_start.hpp"
#include "tests/io/file_fixture.hpp"
#include "tests/message_of.hpp"
#include "tests/ordered_grains.hpp"
#include "tests/scenarios/scenario_fixture.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

using namespace scenario_fixture;
using Catch::Matchers::WithinAbs;
using file_fixture::ScratchDirectory;

namespace {

const std::string yaml = tube_yaml + "start: {random_velocity: 3 m/s}\n";

constexpr double k_t = 570.0;  // N/m
/// Of grains that roll, against a resistance, and are held by springs.
const Overrides rolling = {"grains.rotation=disc", "contact.rolling_friction=0.1",
                           "contact.slip=spring", "contact.slip_stiffness=570 N/m",
                           "contact.slip_damping=100 1/s"};

std::string continued_yaml(const std::filesystem::path& from) {
  return tube_yaml + "start: {kind: continued, from: " + from.string() + "}\n";
}

bool is_at_wall(const Contact& contact) { return contact.name.wall != no_wall; }

/// A state of the tube in which several grains touch, one of them a wall, and its checkpoint.
class EarlierRun {
public:
  explicit EarlierRun(Overrides settings = {}) : settings_(std::move(settings)) {
    const auto start = flow(yaml, settings_);
    Simulation simulation(start.state, start.model, 1);
    simulation.advance(3000);
    const auto& contacts = simulation.state().contacts;
    while (contacts.size() < 5 || std::ranges::none_of(contacts, is_at_wall)) simulation.advance(1);
    state_ = simulation.state();
    io::write_checkpoint(
        directory_ / io::checkpoint_name,
        {.state = state_, .settings = read(yaml, settings_).effective_yaml(), .source = {}});
  }

  /// Grains in the order of their ids.
  State state() const {
    State ordered = state_;
    ordered.grains = ordered_by_id(state_.grains);
    return ordered;
  }

  State continued(const Overrides& overrides = {}) const { return next(overrides).state; }
  ContactModel model(const Overrides& overrides = {}) const { return next(overrides).model; }
  const std::filesystem::path& directory() const { return directory_.path(); }

private:
  scenarios::Flow next(const Overrides& overrides) const {
    Overrides all = settings_;
    all.insert(all.end(), overrides.begin(), overrides.end());
    return flow(continued_yaml(directory_.path()), all);
  }

  Overrides settings_;
  ScratchDirectory directory_;
  State state_;
};

/// Whether grains rotate and springs act: nothing of either may be lost.
bool they_roll() { return GENERATE(false, true); }

Overrides kind(bool rolls) { return rolls ? rolling : Overrides{}; }

double stored_energy(const State& state) { return observe(state).energies.elastic; }

/// m, how far apart the grains with the same id are, at most.
double largest_distance(const State& a, const State& b) {
  const Grains one = ordered_by_id(a.grains), other = ordered_by_id(b.grains);
  double largest = 0.0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    const double x = a.box.metres_x(wrapped_difference(one.position[i].x, other.position[i].x));
    const double y = a.box.metres_y(wrapped_difference(one.position[i].y, other.position[i].y));
    largest = std::max(largest, std::hypot(x, y));
  }
  return largest;
}

void check_nothing_moved(const State& before, const State& after) {
  REQUIRE(after.grains.size() == before.grains.size());
  CHECK(largest_distance(before, after) == 0.0);
  for (std::size_t i = 0; i < before.grains.size(); ++i) {
    const Grain one = grain_at(before, i), other = grain_at(after, i);
    CHECK(std::abs(one.vx - other.vx) < 1e-13);
    CHECK(std::abs(one.vy - other.vy) < 1e-13);
    CHECK(std::abs(one.spin - other.spin) < 1e-10);  // of thousands of rad/s
    CHECK(one.radius == other.radius);
    CHECK(one.mass == other.mass);
  }
}

}  // namespace

TEST_CASE("A continued start has the places and velocities of the earlier end, whatever changes") {
  const bool rolls = they_roll();
  const EarlierRun earlier(kind(rolls));
  if (rolls) {
    const State before = earlier.state();
    CHECK(std::ranges::count(before.grains.spin, 0) < std::ssize(before.grains.spin) / 2);
    CHECK(std::ranges::count(before.grains.spin_kick, 0) < std::ssize(before.grains.spin_kick));
  }
  for (const Overrides& overrides : std::vector<Overrides>{{},
                                                           {"run.steps_per_collision=77"},
                                                           {"contact.stiffness=40 kN/m"},
                                                           {"contact.damping=100", "gravity=3"}}) {
    const State state = earlier.continued(overrides);
    check_nothing_moved(earlier.state(), state);
    CHECK(state.step == 0);
    CHECK(state.tally.grains.begun + state.tally.walls.begun == 0);
  }
}

TEST_CASE("Contacts that last go on, with the energy of the new law and an empty account") {
  const bool rolls = they_roll();
  const EarlierRun earlier(kind(rolls));
  const State before = earlier.state();
  const State after = earlier.continued({"contact.stiffness=4000 N/m"});
  REQUIRE(after.contacts.size() == before.contacts.size());
  double stored = 0.0;
  for (std::size_t i = 0; i < before.contacts.size(); ++i) {
    const Contact& old = before.contacts[i];
    const Contact& now = after.contacts[i];
    CHECK((now.name == old.name));
    CHECK(now.overlap == old.overlap);
    CHECK(now.entry_rate == old.entry_rate);
    CHECK(now.begin <= 0.0);
    CHECK(std::abs(now.duration() - old.duration()) < 1e-15);
    CHECK(now.normal_loss == 0.0);
    CHECK(now.impulse_y == 0.0);
    for (const auto member : {&Contact::friction_x, &Contact::friction_y, &Contact::spring,
                              &Contact::torque, &Contact::rolling_torque})
      CHECK(now.*member == old.*member);
    for (const auto member : {&Contact::spring, &Contact::torque, &Contact::rolling_torque})
      CHECK((old.*member != 0.0) == rolls);
    stored += 0.5 * 4000.0 * old.overlap * old.overlap + 0.5 * k_t * old.spring * old.spring;
  }
  CHECK(std::abs(stored_energy(after) / stored - 1.0) < 1e-13);
}

TEST_CASE("With the same settings a continued run is the earlier run going on") {
  const EarlierRun earlier(kind(they_roll()));
  Simulation uninterrupted(earlier.state(), earlier.model(), 1);
  Simulation continued(earlier.continued(), earlier.model(), 1);
  const std::int64_t begun = uninterrupted.state().tally.grains.begun;
  uninterrupted.advance(2000);
  continued.advance(2000);
  const State& state = continued.state();
  CHECK(state.tally.grains.begun > 20);
  CHECK(state.tally.grains.begun == uninterrupted.state().tally.grains.begun - begun);
  // Rounding of the velocities, once, and what collisions make of it.
  CHECK(largest_distance(uninterrupted.state(), state) < 1e-11);

  // The energy that was stored at the start is no residual.
  const Energies energies = observe(state).energies;
  const Energies before = observe(earlier.state()).energies;
  const double of_this_time = observe(uninterrupted.state()).energies.residual - before.residual;
  CHECK(std::abs(energies.residual - of_this_time) < 1e-9 * before.kinetic);
}

TEST_CASE("A continued start has the same bits in both kinds of stepping") {
  const EarlierRun earlier(kind(they_roll()));
  const State start = earlier.continued({"contact.stiffness=20 kN/m"});
  const ContactModel model = earlier.model({"contact.stiffness=20 kN/m"});
  Simulation plain(start, model, 1, Stepping::plain), windows(start, model, 1, Stepping::windows);
  plain.advance(500);
  windows.advance(500);
  CHECK(state_hash(plain.state()) == state_hash(windows.state()));
}

TEST_CASE("A continued start is refused where the earlier run does not fit") {
  const EarlierRun earlier;
  const std::string continued = continued_yaml(earlier.directory());
  check_mentions(complaint(continued, {"tube.width=21 mm"}), {"tube.width", "0.021", "0.02 in"});
  check_mentions(complaint(continued, {"grains.mass=2 mg"}), {"grains.mass", "earlier run"});
  check_mentions(complaint(continued, {"wall.spacing=1 mm"}), {"wall.spacing"});
  check_mentions(complaint(continued, {"start.from=/nowhere"}),
                 {"start.from", "/nowhere", "checkpoint.h5"});
  check_mentions(complaint(yaml, {"start.from=/nowhere"}), {"start.from", "has no effect"});
  check_mentions(complaint(continued, {"start.axial_velocity=1"}), {"has no effect"});
  check_mentions(complaint(yaml, {"start.kind=continued"}), {"start.from", "is missing"});
}

TEST_CASE("The table of sizes of a run that is continued counts by its content") {
  const ScratchDirectory directory;
  const auto table = [&](const char* name, const char* second) {
    const auto path = directory / name;
    io::write_durably(path, std::string("diameter (mm)\n0.9\n") + second + "\n");
    return "grains.sizes_from=" + path.string();
  };
  const auto from_table = [](const std::string& sizes) {
    return Overrides{"grains.size_distribution=file", sizes};
  };
  const std::string first = table("first.csv", "1.1");
  const EarlierRun earlier(from_table(first));
  const std::string continued = continued_yaml(earlier.directory());
  CHECK(complaint(continued, from_table(first)) == "accepted");
  CHECK(complaint(continued, from_table(table("copy.csv", "1.1"))) == "accepted");
  check_mentions(complaint(continued, from_table(table("other.csv", "1.2"))),
                 {"grains.sizes_from", "make both equal"});
  std::filesystem::remove(directory / "first.csv");
  CHECK(complaint(continued, from_table(table("again.csv", "1.1"))) == "accepted");
}

TEST_CASE("A continued start is refused if its overlaps would release more than there was") {
  const EarlierRun earlier;
  const std::string continued = continued_yaml(earlier.directory());
  State state = earlier.state();
  double px = 0.0, py = 0.0, mass = 0.0, kinetic = 0.0;
  for (std::size_t i = 0; i < state.grains.size(); ++i) {
    const Grain g = grain_at(state, i);
    mass += g.mass;
    px += g.mass * g.vx;
    py += g.mass * g.vy;
    kinetic += 0.5 * g.mass * (g.vx * g.vx + g.vy * g.vy);
  }
  const double random = kinetic - 0.5 * (px * px + py * py) / mass;
  // With f times the stiffness overlaps hold f times the energy: f - 1 times more.
  const double most = 2.0 + random / stored_energy(state);
  const auto stiffer = [&](double factor) {
    return complaint(continued, {"contact.stiffness=" + std::to_string(2000.0 * factor)});
  };
  CHECK(stiffer(0.999 * most) == "accepted");
  check_mentions(stiffer(1.001 * most), {"contact.stiffness: ", "overlaps", "release more energy",
                                         "continue_along: contact.stiffness"});
}

TEST_CASE("A continued start is refused by its state where no setting tells the difference") {
  const EarlierRun earlier;
  const io::Settings settings = io::Settings::from_text(continued_yaml(earlier.directory()), "t",
                                                        scenarios::settings_tables());
  const State fits = flow(yaml).state;
  CHECK_NOTHROW(scenarios::earlier_run(settings, fits));
  const auto refused = [&](auto change) {
    State other = fits;
    change(other);
    return message_of<io::SettingsError>([&] { scenarios::earlier_run(settings, other); });
  };
  const std::vector<std::string> mentions{"start.from", "another box or between other walls"};
  check_mentions(refused([](State& s) { s.box.width *= 1.001; }), mentions);
  check_mentions(refused([](State& s) { s.box.length *= 1.001; }), mentions);
  check_mentions(refused([](State& s) { s.walls[1].line *= 1.001; }), mentions);
  check_mentions(refused([](State& s) { s.walls[0].radius *= 1.001; }), mentions);
  check_mentions(refused([](State& s) { ++s.walls[0].count; }), mentions);
}

TEST_CASE("Velocities half a step before a continued start are those that it holds") {
  const bool rolls = they_roll();
  const EarlierRun earlier(kind(rolls));
  const Overrides softer{"contact.damping=", "contact.restitution=0.9", "contact.stiffness=10 N/m"};
  const State continued = earlier.continued(softer);
  const std::vector<Grain> half =
      scenarios::half_a_step_before(earlier.state(), continued.time_step);
  const double metres_per_second = continued.box.quantum_x() / continued.time_step;
  double largest_change = 0.0, largest_change_of_spin = 0.0;
  for (std::size_t i = 0; i < half.size(); ++i) {
    CHECK_THAT(real(continued.grains.u[i].x) * metres_per_second, WithinAbs(half[i].vx, 1e-12));
    largest_change = std::max(largest_change, std::abs(half[i].vx - grain_at(continued, i).vx));
    if (!rolls) continue;
    CHECK_THAT(real(continued.grains.spin[i]) * quantum_of_angle / continued.time_step,
               WithinAbs(half[i].spin, 1e-9));
    largest_change_of_spin =
        std::max(largest_change_of_spin, std::abs(half[i].spin - grain_at(continued, i).spin));
  }
  CHECK(largest_change > 1e-3);  // some are in contact
  CHECK((largest_change_of_spin > 1.0) == rolls);
}

TEST_CASE("A continued start is refused if its time step is too long for the earlier motion") {
  const EarlierRun earlier;
  check_mentions(complaint(continued_yaml(earlier.directory()),
                           {"gravity=0", "contact.damping=", "contact.restitution=0.9",
                            "contact.stiffness=1e-4 N/m"}),
                 {"start.from", "too fast", "the fastest grain", "stays below"});

  const std::string rotating = yaml + "grains: {rotation: disc}\n";
  State state = flow(rotating).state;
  state.grains.spin[0] = Fixed{1} << 60;  // of 2^64 quanta in a turn, in each step
  const ScratchDirectory directory;
  io::write_checkpoint(directory / io::checkpoint_name,
                       {.state = state, .settings = read(rotating).effective_yaml(), .source = {}});
  const std::string continued = continued_yaml(directory.path()) + "grains: {rotation: disc}\n";
  CHECK(flow(continued).state.grains.size() == state.grains.size());
  const double stiffness = read(rotating).number("contact.stiffness");
  check_mentions(complaint(continued, {"contact.damping=", "contact.restitution=0.9",
                                       "contact.stiffness=" + std::to_string(stiffness / 16.0)}),
                 {"start.from", "spins too fast"});
}

TEST_CASE("A continued start is refused if the earlier state has not as many walls") {
  const EarlierRun earlier;
  io::Checkpoint forged = io::read_checkpoint(earlier.directory() / io::checkpoint_name);
  const auto at_last_wall = [](std::int32_t wall) { return wall == 1; };
  forged.state.walls.pop_back();
  std::erase_if(forged.state.contacts, [&](auto& c) { return at_last_wall(c.name.wall); });
  std::erase_if(forged.state.open_visits, [&](auto& v) { return at_last_wall(v.wall); });
  const auto file = earlier.directory() / "forged.h5";
  io::write_checkpoint(file, forged);
  check_mentions(complaint(continued_yaml(file)),
                 {"start.from: has a state with 1 wall, and periodic_tube has 2", "checkpoint.h5"});
}

TEST_CASE("A continued start does not take an older state than the newest without a word") {
  const EarlierRun earlier;
  const auto newest = earlier.directory() / io::checkpoint_name;
  const auto previous = io::previous_generation(newest);
  std::filesystem::copy_file(newest, previous);
  std::filesystem::resize_file(newest, 1000);
  check_mentions(complaint(continued_yaml(earlier.directory())),
                 {"start.from", "is damaged", previous.string()});
  CHECK(flow(continued_yaml(previous)).state.grains.size() == earlier.state().grains.size());
}

TEST_CASE("Runs can follow each other along what the earlier run does not give") {
  for (const char* key : {"contact.restitution", "contact.stiffness", "gravity", "run.duration"})
    CHECK(scenarios::can_continue_along(key));
  for (const char* key : {"seed", "grains.mass", "wall.spacing", "tube.width",
                          "start.axial_velocity", "output.interval"})
    CHECK_FALSE(scenarios::can_continue_along(key));
}

TEST_CASE(
    "The work of gravity after a continued start is that of the way, also of grains at walls") {
  const EarlierRun earlier;
  const State start = earlier.continued();
  REQUIRE(std::ranges::any_of(start.contacts, is_at_wall));
  Simulation simulation(start, earlier.model(), 1);
  double mass_times_way = 0.0;
  for (int step = 0; step < 300; ++step) {
    const Grains before = ordered_by_id(simulation.state().grains);
    simulation.advance(1);
    const Grains after = ordered_by_id(simulation.state().grains);
    for (std::size_t i = 0; i < after.size(); ++i)
      mass_times_way +=
          after.mass[i]
          * start.box.metres_y(wrapped_difference(after.position[i].y, before.position[i].y));
  }
  const double work = observe(simulation.state()).energies.gravity_work;
  CHECK(work == Approx(start.gravity.y * mass_times_way).epsilon(1e-9));
}
