#include "app/flow_failures.hpp"

#include "engine/exact_sum.hpp"
#include "engine/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

namespace riesel::app {

namespace {

void fail_if_too_fast(const State& state) {
  const FastestGrain fastest = fastest_grain(state);
  const double largest = largest_speed(state.box, state.time_step, state.grains.size());
  if (fastest.speed < largest) return;
  throw RunFailure(fmt::format(
      "grain {} moves at {:.3g} m/s {}, too fast for this tube and time step (limit {:.3g} m/s); "
      "stiffer contacts, a shorter time step or a slower start may help",
      fastest.id, fastest.speed, when(state), largest));
}

void fail_if_too_heavy(const State& state) {
  const double largest = largest_sum(state);
  if (largest < ExactSum::largest_sum) return;
  throw RunFailure(fmt::format(
      "energies or impulses add up to {:.3g} in SI units {}, more than sums can represent "
      "({:.3g}); lighter grains help: masses and stiffness may be scaled together, which changes "
      "no motion",
      largest, when(state), ExactSum::largest_sum));
}

}  // namespace

void fail_if_out_of_range(const State& state) {
  fail_if_too_fast(state);
  fail_if_too_heavy(state);
}

std::optional<std::string> way_through_a_wall(const State& state, double diameter) {
  const double smallest = 2.0 * std::ranges::min(state.grains.radius);
  for (const WallLattice& wall : state.walls)
    if (diameter < wall.gap(state.box))
      return fmt::format("grains of {:.3g} m fit between the wall grains, {:.3g} m apart, and may "
                         "leave the tube; choose wall.spacing below {:.3g} m",
                         diameter, wall.gap(state.box), smallest + 2.0 * wall.radius);
  return std::nullopt;
}

namespace {

std::string cause_of_leaving(const State& state, std::int64_t id) {
  const auto slot = std::ranges::find(state.grains.id, id) - state.grains.id.begin();
  const double diameter = 2.0 * state.grains.radius[static_cast<std::size_t>(slot)];
  return way_through_a_wall(state, diameter)
      .value_or("the contacts are too soft for these velocities; raise contact.stiffness");
}

}  // namespace

void fail_if_through_a_wall(const State& state, const Observables& seen) {
  const auto grain = seen.outside > 0.0 ? grain_outside(state) : std::nullopt;
  if (!grain) return;
  const std::string who =
      seen.outside == 1.0
          ? fmt::format("grain {} has", *grain)
          : fmt::format("{:.0f} grains, grain {} among them, have", seen.outside, *grain);
  throw RunFailure(fmt::format("{} gone through a wall {}: {}", who, when(state),
                               cause_of_leaving(state, *grain)));
}

}  // namespace riesel::app
