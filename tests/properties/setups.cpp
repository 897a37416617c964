#include "tests/properties/setups.hpp"

#include "engine/closed_forms.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

namespace properties {

namespace {

using namespace systems;

double power_of_ten(Dice& dice, double low, double high) {
  return std::pow(10.0, dice.between(low, high));
}

NormalLaw random_normal_law(Dice& dice) {
  switch (dice.below(4)) {
  case 0: {
    const double k = power_of_ten(dice, 4.5, 7.0);
    return HertzKuwabaraKonoLaw{k, dice.between(0.0, 1e-5) * k};
  }
  case 1: {
    const double k = power_of_ten(dice, 3.5, 5.5);
    const double gamma = dice.between(0.0, 1e-6) * k;
    const double alpha = dice.between(1.0, 1.6), beta = dice.between(0.0, 0.6);
    return PowerLaw{k, gamma, alpha, beta, dice.between(1.0, 1.3)};
  }
  default: {
    const double k = power_of_ten(dice, 2.3, 5.3);
    const double restitution = dice.below(5) == 0 ? 1.0 : dice.between(0.3, 1.0);
    return LinearLaw{k, damping_for_restitution(restitution, k, 0.5 * mass, Attraction::keep)};
  }
  }
}

SlipLaw random_slip_law(Dice& dice) {
  switch (dice.below(4)) {
  case 0:
    return LiteralSlip{};
  case 1:
    return ViscousSlip{power_of_ten(dice, 3.0, 5.5)};
  default:
    return CappedSlip{};
  }
}

/// Every tenth set-up's time step is too large to be stable.
double steps_per_contact(std::uint64_t seed, Dice& dice) {
  const double resolved = fewest_steps_per_contact * power_of_ten(dice, 0.0, 1.1);
  Dice other(seed ^ 0xc0a5U);
  return other.below(10) == 0 ? other.between(0.5, 3.0) : resolved;
}

/// Every third box is so long that slices may go askew in it (PlainSteps).
double stretch(std::uint64_t seed) {
  Dice dice(seed ^ 0x10e6U);
  return dice.below(3) == 0 ? dice.between(2.0, 8.0) : 1.0;
}

}  // namespace

double contact_time(const NormalLaw& normal, double reduced_mass, double speed) {
  const double pi = std::acos(-1.0);
  const auto damping_time = [&](const auto& law) {
    const double deepest = elastic_max_overlap(law.elastic_line(), reduced_mass, speed);
    const double force = law.damping(deepest, speed, reduced_mass);
    return force > 0.0 ? pi * reduced_mass * speed / force
                       : std::numeric_limits<double>::infinity();
  };
  return std::min(collision_time(normal, reduced_mass, speed), std::visit(damping_time, normal));
}

// From dice of its own: the other seeds, and all the rest, are as without.
void add_rotation(std::uint64_t seed, double shortest, ContactModel& model, State& state) {
  Dice dice(seed ^ 0x5eedU);
  if (dice.below(2) == 0) return;
  if (dice.below(3) != 0) state.grains.inertia = dice.below(2) == 0 ? disc : sphere;
  if (state.grains.rotate()) model.rolling_friction = dice.below(2) == 0 ? 0.0 : 0.3;
  if (dice.below(3) == 0) return;
  const double k_n = 0.5 * mass * std::pow(std::acos(-1.0) / shortest, 2);
  const double k_t = dice.between(0.05, 1.0) * k_n;
  model.slip = SpringSlip{k_t, dice.below(2) == 0 ? 0.0 : dice.between(0.0, 1.0) / shortest};
}

/// Gives all pairs the same restitution in a third of the set-ups with a linear law.
void equalise_restitution(std::uint64_t seed, ContactModel& model) {
  Dice dice(seed ^ 0xe9a1U);
  const auto* linear = std::get_if<LinearLaw>(&model.normal);
  if (linear == nullptr || dice.below(3) != 0) return;
  model.normal = EqualRestitutionLaw{{linear->k_n, linear->gamma_n * std::sqrt(0.5 * mass)}};
}

void add_slopes(std::uint64_t seed, State& state) {
  Dice dice(seed ^ 0x711dU);
  if (dice.below(3) == 0) state.gravity.x = dice.between(-20.0, 20.0);
  if (dice.below(5) == 0)
    for (WallLattice& wall : state.walls) wall = WallLattice::smooth_at(wall.line);
  if (dice.below(4) != 0) return;
  for (WallLattice& wall : state.walls) {
    wall.motion.velocity = dice.between(-5.0, 5.0);
    if (dice.below(2) == 0) continue;
    wall.motion.amplitude_y = dice.between(0.0, 1e-3);
    wall.motion.frequency = dice.between(0.0, 1e3);
    if (dice.below(2) == 0) wall.motion.amplitude_x = dice.between(-0.5e-3, 0.5e-3);
  }
}

/// Of 65 grains and a few more: whoever tells them apart by six bits takes the first ones for the
/// last. Not closer than any grain of a set-up allows.
void lengthen_walls(std::uint64_t seed, State& state) {
  Dice dice(seed ^ 0x5ea3U);
  constexpr double least_spacing = 0.1e-3;  // m
  const std::int64_t count = 65 + dice.below(3);
  if (dice.below(4) != 0 || state.box.length < least_spacing * static_cast<double>(count)) return;
  for (WallLattice& wall : state.walls) wall.count = count;
}

ContactModel random_model(Dice& dice) {
  // One draw after the other: arguments of one call are evaluated in an order of the compiler's.
  const NormalLaw normal = random_normal_law(dice);
  const SlipLaw slip = random_slip_law(dice);
  const double friction = dice.below(5) == 0 ? 0.0 : dice.between(0.0, 1.0);
  return {normal, slip, friction, dice.below(3) == 0 ? Attraction::clip : Attraction::keep};
}

SetUp random_set_up(std::uint64_t seed) {
  Dice dice(seed);
  const double width = dice.between(4e-3, 15e-3),
               length = stretch(seed) * dice.between(4e-3, 20e-3);
  SetUp set_up{.start = empty_box(width, length),
               .model = random_model(dice),
               .steps = 100 + dice.below(600),
               .equal_masses = dice.below(2) == 0,
               .steps_per_contact = 0.0};
  State& state = set_up.start;
  state.gravity.y = dice.below(3) == 0 ? 0.0 : dice.between(-20.0, 20.0);
  if (dice.below(4) != 0) add_walls(state, 1 + dice.below(30));
  lengthen_walls(seed, state);
  const double speed = power_of_ten(dice, -1.5, 1.2);
  constexpr double fastest_of_walls = 25.0;  // m/s, with what all grains have in common
  const double shortest =
      contact_time(set_up.model.normal, 0.5 * mass, 2.0 * speed + fastest_of_walls);
  // From what nobody should use to what is finer than needed; and no grain crosses half the tube,
  // which it might leave where there are no walls.
  state.time_step = std::min(shortest / steps_per_contact(seed, dice),
                             0.5 * width / (speed * static_cast<double>(set_up.steps)));
  set_up.steps_per_contact = shortest / state.time_step;
  add_rotation(seed, shortest, set_up.model, state);
  equalise_restitution(seed, set_up.model);
  add_slopes(seed, state);
  const Throw where{.left = 0.0,
                    .right = width,
                    .low = 0.0,
                    .high = length,
                    .speed = speed,
                    .common_vy = dice.between(-20.0, 20.0),
                    .polydispersity = set_up.equal_masses ? 0.0 : dice.between(0.0, 0.5)};
  const double room = width * length / (radius * radius);
  const auto count = static_cast<std::size_t>(1.0 + dice.between(0.0, 0.12) * room);
  throw_grains(state, count, where, dice);
  return set_up;
}

SetUp random_flow(std::uint64_t seed) {
  Dice dice(seed);
  SetUp flow{.start = empty_box(8e-3, dice.between(8e-3, 30e-3)),
             .model = random_model(dice),
             .steps = 1'000'000,
             .equal_masses = false,
             .steps_per_contact = dice.between(20.0, 60.0)};
  State& state = flow.start;
  const bool sheared = dice.below(2) == 0;
  if (!sheared) state.gravity.y = dice.between(5.0, 20.0);
  add_walls(state, static_cast<std::int64_t>(state.box.length / dice.between(0.7e-3, 1.0e-3)));
  if (sheared) state.walls[1].motion.velocity = dice.between(1.0, 10.0);
  constexpr double fastest = 10.0;  // m/s, of two grains that meet
  const double shortest = contact_time(flow.model.normal, 0.5 * mass, fastest);
  state.time_step = shortest / flow.steps_per_contact;
  add_rotation(seed, shortest, flow.model, state);
  const Throw where{.left = 0.0,
                    .right = state.box.width,
                    .low = 0.0,
                    .high = state.box.length,
                    .speed = power_of_ten(dice, -1.0, 0.5),
                    .polydispersity = 0.2};
  const double room = state.box.width * state.box.length / (radius * radius);
  throw_grains(state, static_cast<std::size_t>(dice.between(0.08, 0.155) * room), where, dice);
  return flow;
}

std::string description(const SetUp& s) {
  static const std::vector<const char*> normal{"linear", "equal restitution", "power", "Hertz"};
  static const std::vector<const char*> slip{"capped", "literal", "viscous", "spring"};
  std::vector<char> line(300);
  const double fastest = s.start.grains.size() == 0 ? 0.0 : std::abs(grain_at(s.start, 0).vx);
  std::snprintf(
      line.data(), line.size(),
      "%zu grains of inertia %.1f, %.3g x %.3g m, walls %zu, g (%.3g, %.3g), %s law, %s slip, mu "
      "%.3g, %s, dt "
      "%.3g s, %lld steps, a speed %.3g m/s",
      s.start.grains.size(), s.start.grains.inertia, s.start.box.width, s.start.box.length,
      s.start.walls.size(), s.start.gravity.x, s.start.gravity.y, normal[s.model.normal.index()],
      slip[s.model.slip.index()], s.model.friction,
      s.model.attraction == Attraction::clip ? "clip" : "keep", s.start.time_step,
      static_cast<long long>(s.steps), fastest);
  return line.data();
}

}  // namespace properties
