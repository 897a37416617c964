#include "app/limit_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <optional>

namespace riesel::app {

namespace {

/// The contact that had it, if it lasts.
std::string contact_with(const LargestOverlap& largest, const State& state) {
  const auto deepest =
      std::find_if(state.contacts.begin(), state.contacts.end(), [&](const Contact& contact) {
        return (contact.name.wall != no_wall) == largest.at_wall
               && contact.max_overlap >= largest.overlap;
      });
  if (deepest == state.contacts.end()) return "in a contact that has ended";
  const auto& [wall, grain, partner] = deepest->name;
  return wall == no_wall
             ? fmt::format("between grains {} and {}", grain, partner)
             : fmt::format("of grain {} with grain {} of wall {}", grain, partner, wall);
}

std::string overlap_exceeded(const State& state, const LargestOverlap& largest) {
  return fmt::format("an overlap of {:.3g} m, {:.3g} of the radius of the smaller body, {}; raise "
                     "contact.stiffness",
                     largest.overlap, largest.ratio, contact_with(largest, state));
}

std::string energy_error_exceeded(double ratio) {
  return fmt::format("{:.3g} of the energy turned over came or went by errors of the time step, "
                     "which is too long for the forces; raise run.steps_per_collision",
                     ratio);
}

std::string speed_exceeded(const FastestGrain& fastest) {
  return fmt::format("grain {} moves with {:.4g} m/s: the brake of the walls has failed; lower the "
                     "velocity at the start, or raise contact.stiffness",
                     fastest.id, fastest.speed);
}

}  // namespace

std::vector<std::string> LimitWatch::newly_exceeded(const State& state, const Observables& seen) {
  std::vector<std::string> messages;
  const auto look = [&](std::optional<double>& limit, const char* key, double value,
                        const auto& message) {
    if (!limit || !(value > *limit)) return;
    limit.reset();
    messages.push_back(fmt::format("at t = {:.6g} s (step {}) {} is exceeded: {}", seen.time,
                                   state.step, key, message()));
  };
  const LargestOverlap largest = limits_.overlap ? largest_overlap(state) : LargestOverlap{};
  look(limits_.overlap, "limits.overlap", largest.ratio,
       [&] { return overlap_exceeded(state, largest); });
  const double error = energy_error_ratio(state, seen.energies);
  look(limits_.energy_error, "limits.energy_error", error,
       [&] { return energy_error_exceeded(error); });
  const FastestGrain fastest = limits_.speed ? fastest_grain(state) : FastestGrain{};
  look(limits_.speed, "limits.speed", fastest.speed, [&] { return speed_exceeded(fastest); });
  return messages;
}

}  // namespace riesel::app
