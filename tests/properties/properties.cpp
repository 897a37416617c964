#include "tests/properties/properties.hpp"

#include "engine/closed_forms.hpp"
#include "engine/observables.hpp"
#include "engine/simulation.hpp"
#include "io/checkpoint.hpp"
#include "tests/engine/same_states.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <utility>
#include <variant>

namespace properties {

namespace {

using namespace systems;

/// One leg of a journey: as one process of a user would do it.
struct Leg {
  Stepping stepping;
  int threads;
  bool shuffle, observe, profile, through_file;
  Askew askew;
  Sharing sharing;
  std::int64_t steps;

  std::string name() const {
    static constexpr std::array names{"plain", "windows", "automatic"};
    return std::string(names.at(static_cast<std::size_t>(stepping))) + " x "
           + std::to_string(threads)
           + (askew.least_bytes == 0.0
                  ? ", askew by " + std::to_string(askew.steps) + " in slices of "
                        + std::to_string(std::llround(askew.bytes_of_slice)) + " bytes"
                  : "")
           + (sharing == Sharing::apart ? ", apart" : "") + (shuffle ? ", shuffled" : "")
           + (observe ? ", observed" : "") + (profile ? ", profiled" : "")
           + (through_file ? ", through a file" : "") + ", " + std::to_string(steps) + " steps";
  }
};

Leg random_leg(Dice& dice, std::int64_t left) {
  static constexpr std::array steppings{Stepping::plain, Stepping::windows, Stepping::windows,
                                        Stepping::automatic};
  Leg leg{};
  leg.stepping = steppings.at(static_cast<std::size_t>(dice.below(steppings.size())));
  // Teams larger than the machine are slow.
  leg.threads = dice.below(4) == 0 ? 2 + static_cast<int>(dice.below(3)) : 1;
  leg.shuffle = dice.below(3) == 0;
  leg.observe = dice.below(2) == 0;
  leg.profile = dice.below(4) == 0;
  leg.through_file = dice.below(6) == 0;
  if (dice.below(2) == 0)
    leg.askew = {.bytes_of_slice = 200.0 * static_cast<double>(1 + dice.below(60)),
                 .steps = 2 + dice.below(10),
                 .least_bytes = 0.0,
                 .contacts_per_grain = 0.0};
  // Without slices that go askew most teams are apart.
  leg.sharing = dice.below(4) == 0 ? Sharing::together : Sharing::automatic;
  if (leg.askew.least_bytes > 0.0 && dice.below(2) == 0) leg.sharing = Sharing::apart;
  leg.steps = dice.below(3) == 0 ? left : 1 + dice.below(left);
  return leg;
}

State through_checkpoint(const State& state, const std::filesystem::path& scratch) {
  const auto file = scratch / "checkpoint.h5";
  io::write_checkpoint(file, {.state = state, .settings = "", .source = ""});
  return io::read_checkpoint(file).state;
}

State travel(State state, const ContactModel& model, const Leg& leg, Dice& dice,
             const std::filesystem::path& scratch) {
  const bool is_flow = state.grains.size() > 0 && !state.walls.empty();  // only those are kept
  if (leg.through_file && is_flow) state = through_checkpoint(state, scratch);
  if (leg.shuffle) state = shuffled(std::move(state), 7);
  const std::int64_t last = state.step + leg.steps;
  Simulation simulation(std::move(state), model, leg.threads, leg.stepping, leg.askew, leg.sharing);
  if (leg.profile) simulation.start_profile();
  while (simulation.state().step < last) {
    simulation.advance(std::min(last - simulation.state().step, 1 + dice.below(300)));
    if (leg.observe) (void)observe(simulation.state());
  }
  return simulation.state();
}

/// When a grain is found to be lost depends on when the grains are sorted, and whether slices are
/// askew then.
bool tells_of_lost_grain(const std::string& failure) {
  return failure.find("has left the system") != std::string::npos
         || failure.find("was thrown farther") != std::string::npos;
}

/// kg m/s along the tube, with the kicks that the next step takes up: what contacts have given to
/// the grains, and they had at first. Gravity's part is not in it.
double momentum_along(const State& state) {
  const Grains& g = state.grains;
  const double velocity = state.box.quantum_y() / state.time_step;
  double sum = 0.0;
  for (std::size_t i = 0; i < g.size(); ++i)
    sum += g.mass[i] * velocity * real(wrapped_sum(g.u[i].y, g.kick[i].y));
  return sum;
}

/// kg m/s, by which two sums over the grains may differ for their rounding.
double rounding_of_momentum(const State& state) {
  double sizes = 0.0;
  for (std::size_t i = 0; i < state.grains.size(); ++i)
    sizes += state.grains.mass[i] * std::abs(grain_at(state, i).vy);
  return 1e-9 * sizes;
}

Outcome outcome(const SetUp& set_up, int threads, Stepping stepping) {
  try {
    return {advanced(set_up.start, set_up.model, set_up.steps, threads, stepping), {}};
  } catch (const RunFailure& failure) {
    return {{}, failure.what()};
  }
}

/// One that the plain run has not found yet.
bool has_lost_grain(const State& state) {
  return std::ranges::any_of(state.grains.position, [&](const FixedVector& at) {
    return std::abs(state.box.metres_x(at.x) - 0.5 * state.box.width) > 1.5 * state.box.width;
  });
}

/// By contacts that should have lost it, or where nobody has won or lost it, by more than the error
/// of the time step.
Complaints energy_out_of_balance(const SetUp& set_up, const State& end, const Energies& energies) {
  Complaints complaints;
  // A force cut off at zero gives back what the damping had taken too much.
  if (set_up.model.attraction == Attraction::keep && energies.normal_loss < 0.0)
    complaints.emplace_back("the damping has won energy");
  // Second order, as of single impacts: J.
  const double borne =
      3.0 / (set_up.steps_per_contact * set_up.steps_per_contact)
      * energy_turned_over(end.origin.energy, energies.gravity_work, energies.wall_work);
  const SlipLaw& slip = set_up.model.slip;
  // Springs give back what they store; only friction that is capped never overshoots.
  const double borne_of_friction = std::holds_alternative<CappedSlip>(slip) ? 0.0 : borne;
  if (!std::holds_alternative<SpringSlip>(slip) && energies.friction_loss < -borne_of_friction)
    complaints.push_back("friction has won energy: "
                         + std::to_string(-energies.friction_loss / borne)
                         + " times what the time step explains");
  // What the grains have and nobody gave them.
  const double won = -(energies.normal_loss + energies.friction_loss + energies.residual);
  if (!(won <= borne))
    complaints.push_back("energy has come from nowhere: " + std::to_string(won / borne)
                         + " times what the time step explains");
  // Nor is any lost that contacts have not lost. In ten thousand set-ups it is 25 times, at most.
  if (!(std::abs(energies.residual) <= 100.0 * borne))
    complaints.push_back("the balance of energy is off by "
                         + std::to_string(energies.residual / borne)
                         + " times what the time step explains");
  return complaints;
}

}  // namespace

std::int64_t contacts_begun(const State& state) {
  return state.tally.grains.begun + state.tally.walls.begun;
}

Outcome reference(const SetUp& set_up) { return outcome(set_up, 1, Stepping::plain); }

Outcome by_windows(const SetUp& set_up, int threads) {
  return outcome(set_up, threads, Stepping::windows);
}

Complaints same_by_windows(const SetUp& set_up, const Outcome& expected, int threads) {
  const Outcome found = by_windows(set_up, threads);
  if (tells_of_lost_grain(found.failure) && tells_of_lost_grain(expected.failure)) return {};
  if (found.failure != expected.failure)
    return {"\"" + found.failure + "\" by windows, \"" + expected.failure + "\" plainly"};
  if (!found.failure.empty() || same_states::same(found.end, expected.end)) return {};
  return {"other bits by windows on " + std::to_string(threads) + " threads"};
}

Complaints same_bits(const SetUp& set_up, const Outcome& expected, std::uint64_t seed,
                     const std::filesystem::path& scratch) {
  constexpr int journeys = 4;
  Complaints complaints;
  Dice dice(seed);
  for (int i = 0; i < journeys; ++i) {
    State state = set_up.start;
    std::string way;
    try {
      while (state.step < set_up.steps) {
        const Leg leg = random_leg(dice, set_up.steps - state.step);
        way += (way.empty() ? "" : "; ") + leg.name();
        state = travel(std::move(state), set_up.model, leg, dice, scratch);
      }
      if (expected.failure.empty() && !same_states::same(state, expected.end))
        complaints.push_back("other bits by " + way);
      if (!expected.failure.empty() && !tells_of_lost_grain(expected.failure))
        complaints.push_back("no failure by " + way);
    } catch (const std::exception& failure) {
      const bool may_be_lost = !expected.failure.empty() || has_lost_grain(expected.end);
      if (expected.failure != failure.what()
          && !(may_be_lost && tells_of_lost_grain(failure.what())))
        complaints.push_back(std::string(failure.what()) + " by " + way);
    }
  }
  return complaints;
}

Complaints balances(const SetUp& set_up, const Outcome& outcome) {
  Complaints complaints;
  if (!outcome.failure.empty()) return complaints;
  const State& end = outcome.end;
  const auto going_on = end.tally.grains.begun - end.tally.grains.ended + end.tally.walls.begun
                        - end.tally.walls.ended;
  if (going_on != static_cast<std::int64_t>(end.contacts.size()))
    complaints.emplace_back("contacts that neither last nor have ended");
  const Observables seen = observe(end);
  const double gained = momentum_along(end) - momentum_along(set_up.start);
  const double given = seen.wall_impulse_y;
  if (std::abs(gained - given) > rounding_of_momentum(end) + 1e-9 * std::abs(given))
    complaints.push_back("the walls gave " + std::to_string(given) + " kg m/s and the grains got "
                         + std::to_string(gained));
  if (set_up.equal_masses && end.walls.empty()
      && integer_momentum(end) != integer_momentum(set_up.start))
    complaints.emplace_back("momentum is not conserved");
  if (set_up.steps_per_contact >= fewest_steps_per_contact)
    for (const std::string& more : energy_out_of_balance(set_up, end, seen.energies))
      complaints.push_back(more);
  return complaints;
}

Impact random_impact(std::uint64_t seed) {
  Dice dice(seed);
  State state = empty_box(2.0, 20e-3);  // so wide that nothing flies away
  Impact impact{.gain = 0.0,
                .residual = 0.0,
                .contacts = 0,
                .steps_per_contact = std::pow(10.0, dice.between(1.0, 2.5)),
                .model = random_model(dice)};
  const double speed = std::pow(10.0, dice.between(-2.0, 1.5));
  const double angle = dice.between(-1.0, 1.0) * std::acos(-1.0) / 2.0;
  const bool on_wall = dice.below(2) == 0;
  const double reduced_mass = on_wall ? mass : 0.5 * mass;
  const double shortest = contact_time(impact.model.normal, reduced_mass, speed);
  state.time_step = shortest / impact.steps_per_contact;
  add_rotation(seed, shortest, impact.model, state);
  // Just apart, so that it meets the other at a place that a step does not know.
  const double apart = 1e-3 * radius + dice.between(0.0, 1.0) * speed * state.time_step;
  const double offset = dice.between(-1.0, 1.0) * (on_wall ? wall_radius : 2.0 * radius);
  double energy = 0.0;
  if (on_wall) {
    state.walls.push_back({.line = 1.0, .radius = wall_radius, .count = 30});
    const double height = std::sqrt(std::pow(radius + wall_radius, 2) - offset * offset) + apart;
    add_grain(state, grain(1.0 - height, 10e-3 + offset, speed * std::cos(angle),
                           speed * std::sin(angle)));
    energy = 0.5 * mass * speed * speed;
  } else {
    const double distance = std::sqrt(std::max(0.0, 4.0 * radius * radius - offset * offset));
    add_grain(state, grain(1.0, 10e-3, 0.0, 0.0));
    add_grain(state, grain(1.0 - distance - apart, 10e-3 + offset, speed, 0.0));
    energy = 0.25 * mass * speed * speed;
  }
  if (state.grains.rotate()) {
    const double surface_speed = dice.between(-1.0, 1.0) * speed;
    state.grains.spin[0] =
        nearest_fixed(surface_speed / radius * state.time_step / quantum_of_angle);
    energy += 0.5 * state.grains.inertia * mass * surface_speed * surface_speed;
  }
  Simulation simulation(std::move(state), impact.model, 1, Stepping::windows);
  const auto energies = [&] { return observe(simulation.state()).energies; };
  const auto energy_now = [&] {
    const Energies e = energies();
    return e.kinetic + e.rotational + e.elastic;
  };
  const double before = energy_now();
  // At grazing angles an impact is over sooner than a head-on one, or does not happen; at a wall
  // others may follow; and where the damping is strong or friction holds, the two stay together.
  simulation.advance(static_cast<std::int64_t>(10.0 * impact.steps_per_contact));
  impact.gain = (energy_now() - before) / energy;
  impact.residual = energies().residual / energy;
  impact.contacts = contacts_begun(simulation.state());
  return impact;
}

}  // namespace properties
