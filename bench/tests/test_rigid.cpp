// The program for rigid grains: its impacts against the engine's stiff contacts, its events against
// what is known of them, its flows against the conservation laws.
#include "bench/rigid/first_touch.hpp"
#include "bench/rigid/impact_rule.hpp"
#include "bench/rigid/rigid_flow.hpp"
#include "bench/rigid/tournament.hpp"
#include "engine/random.hpp"
#include "engine/simulation.hpp"
#include "tests/catch.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace riesel;
using namespace riesel::bench;

namespace {

constexpr double radius = 0.5e-3, mass = 1e-6, shortest = 1e-7;

ContactModel model_of(double k_n, double restitution, double mu,
                      Attraction attraction = Attraction::keep) {
  return {.normal =
              LinearLaw{k_n, damping_for_restitution(restitution, k_n, mass, Attraction::keep)},
          .slip = CappedSlip{},
          .friction = mu,
          .attraction = attraction};
}

/// A tube without grains, whose wall grains stand with gaps.
State empty_tube(double gravity = 10.0) {
  State state;
  state.box = {.width = 10e-3, .length = 9.6e-3};
  state.walls = {{.line = 0.0, .radius = 0.33e-3, .count = 8},
                 {.line = 10e-3, .radius = 0.33e-3, .count = 8}};
  state.gravity.y = gravity;
  state.time_step = 1e-6;
  return state;
}

Grain grain_of(double x, double y, double vx, double vy) {
  return {.x = x, .y = y, .vx = vx, .vy = vy, .radius = radius, .mass = mass};
}

/// Grains of two masses at the sites of a lattice, moving in all directions.
State crowd(double gravity = 10.0) {
  State state = empty_tube(gravity);
  for (int row = 0; row < 7; ++row)
    for (int column = 0; column < 7; ++column) {
      const double angle = 2.0 * std::numbers::pi * (0.37 * row + 0.61 * column);
      Grain grain = grain_of(1.1e-3 + 1.3e-3 * column, 0.7e-3 + 1.3e-3 * row, std::cos(angle),
                             1.0 + std::sin(angle));
      if ((row + column) % 2 == 0) grain.mass *= 1.2;
      add_grain(state, grain);
    }
  return state;
}

/// J
double kinetic_energy(const RigidFlow& flow) {
  double energy = 0.0;
  for (std::size_t i = 0; i < flow.size(); ++i) {
    const Grain g = flow.grain(i);
    energy += 0.5 * g.mass * (g.vx * g.vx + g.vy * g.vy);
  }
  return energy;
}

double momentum_y(const RigidFlow& flow) {
  double momentum = 0.0;
  for (std::size_t i = 0; i < flow.size(); ++i) momentum += flow.grain(i).mass * flow.grain(i).vy;
  return momentum;
}

/// m, the deepest overlap of two grains or of a grain and a wall grain.
double deepest_overlap(const RigidFlow& flow, const State& start) {
  const auto nearest = [&](double dy) {
    return dy - start.box.length * std::nearbyint(dy / start.box.length);
  };
  double deepest = 0.0;
  for (std::size_t i = 0; i < flow.size(); ++i) {
    const Grain a = flow.grain(i);
    for (std::size_t j = 0; j < i; ++j) {
      const Grain b = flow.grain(j);
      deepest = std::max(deepest, 2.0 * radius - std::hypot(a.x - b.x, nearest(a.y - b.y)));
    }
    for (const WallLattice& wall : start.walls)
      for (int k = 0; k < wall.count; ++k) {
        const double dy = nearest(a.y - static_cast<double>(k) * wall.spacing(start.box));
        deepest = std::max(deepest, radius + wall.radius - std::hypot(a.x - wall.line, dy));
      }
  }
  return deepest;
}

}  // namespace

TEST_CASE("the impact of rigid grains is the limit of stiff contacts", "[rigid]") {
  constexpr double k_n = 2e8;
  for (const Attraction attraction : {Attraction::keep, Attraction::clip})
    for (const double restitution : {1.0, 0.9, 0.6})
      for (const double slip : {0.05, 1.5}) {  // that friction stops, and that it does not
        const ContactModel model = model_of(k_n, restitution, 0.4, attraction);
        const LinearLaw law = std::get<LinearLaw>(model.normal);
        State state = empty_tube(0.0);
        const double t_col = LinearContact{k_n, law.gamma_n, 0.5 * mass}.collision_time();
        state.time_step = t_col / 200.0;
        add_grain(state, grain_of(4e-3, 4e-3, 0.5, slip));
        add_grain(state, grain_of(5e-3 + 1e-9, 4e-3, -0.5, 0.0));
        Simulation soft(state, model, 1);
        soft.advance(400);
        REQUIRE(soft.state().tally.grains.ended == 1);
        const Grain left = grain_at(soft.state(), slots_by_id(soft.state().grains)[0]);

        const ImpactRule rule = rigid_limit({k_n, law.gamma_n, 0.5 * mass, attraction}, 0.4);
        const Impulse impulse = impulse_of(rule, 0.5 * mass, 1.0, 0.0, -1.0, -slip);
        CAPTURE(static_cast<int>(attraction), restitution, slip);
        CHECK(left.vx == Approx(0.5 + impulse.x / mass).margin(2e-3));
        CHECK(left.vy == Approx(slip + impulse.y / mass).margin(2e-3));
      }
}

TEST_CASE("a polynomial first touches zero where it comes down to it", "[rigid]") {
  const Polynomial<3> twice{{2.0, -3.0, 1.0}};  // (t - 1)(t - 2)
  CHECK(first_touch(twice, 3.0).value() == Approx(1.0));
  CHECK_FALSE(first_touch(twice, 0.9));
  const Polynomial<3> leaving{{-1e-20, 1.0, 1.0}}, approaching{{1e-20, -1.0, 1.0}},
      deep{{-1e-20, -1.0, 1.0}};
  CHECK_FALSE(first_touch(leaving, 3.0));
  CHECK(first_touch(approaching, 3.0).value() == Approx(0.0).margin(1e-15));
  CHECK(first_touch(deep, 3.0).value() == 0.0);
  // Leaves, turns round and comes back: (t)(t - 1)(t - 2)(t - 4) is positive between 1 and 2.
  const Polynomial<5> back{{0.0, -8.0, 14.0, -7.0, 1.0}};
  CHECK(first_touch(back, 5.0).value() == 0.0);
  const Polynomial<5> raised{{0.5, -8.0, 14.0, -7.0, 1.0}};
  const double touch = first_touch(raised, 5.0).value();
  CHECK(raised.at(touch) == Approx(0.0).margin(1e-12));
  CHECK(touch < 0.1);
  const Polynomial<5> above{{20.0, -8.0, 14.0, -7.0, 1.0}};
  CHECK_FALSE(first_touch(above, 5.0));
}

TEST_CASE("the first of a tournament has the least time", "[rigid]") {
  constexpr std::size_t players = 37;
  Tournament tournament(players);
  std::vector<double> times(players, 2.0);
  const RandomStream random(1, Use::velocity);
  for (std::size_t i = 0; i < players; ++i) tournament.set(i, times[i]);
  for (std::size_t turn = 0; turn < 1000; ++turn) {
    const auto [a, b] = random.normal(turn);
    const auto who = static_cast<std::size_t>(1e6 * std::abs(b)) % players;
    times[who] = a;
    tournament.set(who, a);
    CHECK(tournament.time_of_first() == *std::min_element(times.begin(), times.end()));
    CHECK(times[tournament.first()] == tournament.time_of_first());
  }
}

TEST_CASE("two rigid grains meet when their gap is closed, across the seam too", "[rigid]") {
  State state = empty_tube();
  add_grain(state, grain_of(4e-3, 9.0e-3, 0.0, 1.0));
  add_grain(state, grain_of(4e-3, 2.0e-3, 0.0, -1.0));  // the gap is 1.6 mm
  RigidFlow flow(state, model_of(2000.0, 1.0, 0.5), shortest);
  flow.advance(0.79e-3);
  CHECK(flow.counts().impacts == 0);
  flow.advance(0.02e-3);
  CHECK(flow.counts().impacts == 1);
  CHECK(flow.grain(0).vy == Approx(-1.0 + 10.0 * 0.81e-3));
  CHECK(flow.grain(1).vy == Approx(1.0 + 10.0 * 0.81e-3));
}

TEST_CASE("rigid grains that go round the seam many times meet whom they come to", "[rigid]") {
  State state = empty_tube(0.0);
  add_grain(state, grain_of(4e-3, 5e-3, 0.0, 60.0));
  add_grain(state, grain_of(6e-3, 5e-3, -0.5, -60.0));  // level with the first each 80 us
  RigidFlow flow(state, model_of(2000.0, 1.0, 0.0), shortest);
  flow.advance(1.9e-3);  // 24 times past each other, 1 mm and more apart in x
  CHECK(flow.counts().impacts == 0);
  flow.advance(0.2e-3);
  CHECK(flow.counts().impacts > 0);

  RigidFlow at_once(state, model_of(2000.0, 1.0, 0.0), shortest);
  at_once.advance(2.1e-3);
  CHECK(at_once.counts().impacts == flow.counts().impacts);
  CHECK(at_once.grain(0).vx == Approx(flow.grain(0).vx).epsilon(1e-6));
  CHECK(deepest_overlap(at_once, state) < 1e-12);
}

TEST_CASE("a meeting that somebody has prevented does not happen", "[rigid]") {
  State state = empty_tube(0.0);
  add_grain(state, grain_of(3e-3, 5e-3, 0.0, 0.0));
  add_grain(state, grain_of(4.5e-3, 5e-3, -0.5, 0.0));   // would meet the first after 1 ms
  add_grain(state, grain_of(4.3e-3, 3.5e-3, 0.0, 1.0));  // meets the second before
  RigidFlow flow(state, model_of(2000.0, 1.0, 0.0), shortest);
  flow.advance(1.8e-3);  // at once, as each advance foresees everything anew
  CHECK(flow.counts().impacts == 1);
  CHECK(flow.grain(0).vx == 0.0);
  CHECK(flow.grain(1).vy > 0.5);
}

TEST_CASE("a rigid grain does at the wall what a stiff one does", "[rigid]") {
  constexpr double k_n = 2e8;
  const ContactModel model = model_of(k_n, 0.8, 0.3);
  State state = empty_tube();
  const LinearLaw law = std::get<LinearLaw>(model.normal);
  state.time_step = LinearContact{k_n, law.gamma_n, mass}.collision_time() / 50.0;
  add_grain(state, grain_of(1.2e-3, 1e-3, -0.5, 0.8));
  RigidFlow rigid(state, model, shortest);
  Simulation soft(state, model, 1);
  for (int part = 1; part <= 3; ++part) {  // to the wall, back, and on
    rigid.advance(1e-3);
    soft.advance(std::llround(1e-3 * part / state.time_step) - soft.state().step);
    CHECK(rigid.counts().wall_impacts == soft.state().tally.walls.begun);
    const Grain a = rigid.grain(0), b = grain_at(soft.state(), 0);
    CHECK(a.x == Approx(b.x).margin(1e-6));
    CHECK(a.y == Approx(b.y).margin(1e-6));
    CHECK(a.vx == Approx(b.vx).margin(2e-3));
    CHECK(a.vy == Approx(b.vy).margin(2e-3));
  }
  CHECK(rigid.counts().wall_impacts > 0);
}

TEST_CASE("a flow of elastic rigid grains keeps its energy", "[rigid]") {
  const State state = crowd(0.0);
  RigidFlow flow(state, model_of(2000.0, 1.0, 0.0), shortest);
  const double energy = kinetic_energy(flow);
  for (int part = 0; part < 20; ++part) flow.advance(5e-3);
  CHECK(flow.counts().impacts > 1000);
  CHECK(flow.counts().wall_impacts > 300);
  CHECK(kinetic_energy(flow) == Approx(energy).epsilon(1e-10));
}

TEST_CASE("what rigid grains lose along the tube the walls have got", "[rigid]") {
  const State state = crowd();
  RigidFlow flow(state, model_of(2000.0, 0.9, 0.5), shortest);
  const double before = momentum_y(flow), weight = 10.0 * total_mass(state.grains);
  double energy = kinetic_energy(flow);
  for (int part = 1; part <= 20; ++part) {
    flow.advance(5e-3);
    CHECK(momentum_y(flow)
          == Approx(before + weight * 5e-3 * part + flow.counts().wall_impulse_y).epsilon(1e-10));
    CHECK(deepest_overlap(flow, state) < 1e-12);
  }
  CHECK(flow.counts().wall_impulse_y < 0.0);
  State level = crowd(0.0);
  RigidFlow cooling(level, model_of(2000.0, 0.9, 0.5), shortest);
  for (int part = 0; part < 20; ++part) {
    cooling.advance(5e-3);
    CHECK(kinetic_energy(cooling) < energy);
    energy = kinetic_energy(cooling);
  }
  CHECK(100 * cooling.counts().elastic < cooling.counts().impacts);
}

TEST_CASE("rigid grains that would meet infinitely often go on", "[rigid]") {
  State state = empty_tube(0.0);
  // A row that closes up: with e_N = 0.3 its impacts have no end without the shortest interval.
  for (int i = 0; i < 7; ++i)
    add_grain(state, grain_of(1.5e-3 + 1.05e-3 * i, 5e-3, i == 0 ? 1.0 : (i == 6 ? -1.0 : 0.0), 0));
  RigidFlow flow(state, model_of(2000.0, 0.3, 0.5), shortest);
  flow.advance(5e-3);
  CHECK(flow.counts().elastic > 0);
  CHECK(flow.counts().impacts < 10000);
  CHECK(deepest_overlap(flow, state) < 1e-12);
}

TEST_CASE("what the program for rigid grains does not know it rejects", "[rigid]") {
  const auto reject = [](const State& state, const ContactModel& model) {
    CHECK_THROWS_AS(RigidFlow(state, model, shortest), std::invalid_argument);
  };
  const ContactModel known = model_of(2000.0, 0.9, 0.5);
  ContactModel other = known;
  other.normal = HertzKuwabaraKonoLaw{1e6, 1.0};
  reject(crowd(), other);
  other = known;
  other.slip = SpringSlip{1000.0, 0.0};
  reject(crowd(), other);
  State leaning = crowd();
  leaning.gravity.x = 1.0;
  reject(leaning, known);
  State smooth = crowd();
  smooth.walls[0] = WallLattice::smooth_at(0.0);
  reject(smooth, known);
  State small = empty_tube();
  small.box.length = 2.4e-3;
  small.walls[0].count = small.walls[1].count = 2;
  add_grain(small, grain_of(5e-3, 1e-3, 0.0, 0.0));
  reject(small, known);
}
