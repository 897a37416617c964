#include "app/limit_watch.hpp"

#include "app/flow_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace riesel::app {

namespace {

/// The contact with the largest overlap, and its times.
std::string contact_with(const LargestOverlap& largest, const State& state) {
  const Contact& contact = *largest.contact;
  const std::string bodies = bodies_of(contact.name);
  const bool lasts = contact.end > state.time();
  return lasts ? fmt::format("between {} since t = {:.8g} s", bodies, contact.begin)
               : fmt::format("between {} from t = {:.8g} s to {:.8g} s", bodies, contact.begin,
                             contact.end);
}

std::string overlap_exceeded(const State& state, const LargestOverlap& largest) {
  return fmt::format("an overlap of {:.3g} m, {:.3g} of the radius of the smallest body, {}; raise "
                     "contact.stiffness",
                     largest.overlap, largest.ratio, contact_with(largest, state));
}

std::string energy_error_exceeded(double ratio) {
  return fmt::format(
      "errors of the time step created or destroyed a fraction {:.3g} of the energy turned over: "
      "the step is too long for the forces; raise run.steps_per_collision",
      ratio);
}

std::string steps_too_few(double steps) {
  return fmt::format("the shortest twentieth of the contacts lasts about {:.3g} steps, which does "
                     "not resolve them; raise run.steps_per_collision, or contact.stiffness "
                     "where grains run through the walls",
                     steps);
}

std::string speed_exceeded(const FastestGrain& fastest) {
  return fmt::format(
      "grain {} moves at {:.4g} m/s, which no wall brakes enough; lower the velocity "
      "at the start, or raise contact.stiffness",
      fastest.id, fastest.speed);
}

}  // namespace

std::string_view key_of_limit(std::string_view message) {
  return message.substr(0, message.find(' '));
}

LimitWatch::LimitWatch(const scenarios::RunLimits& limits, std::vector<std::string> warnings)
    : limits_(limits), warnings_(std::move(warnings)) {}

bool LimitWatch::has_warned_of(std::string_view key) const {
  return std::ranges::any_of(warnings_,
                             [&](const std::string& warning) { return warning.starts_with(key); });
}

std::vector<std::string> LimitWatch::newly_exceeded(const State& state, const Observables& seen) {
  std::vector<std::string> messages;
  const auto look = [&](const std::optional<double>& limit, std::string_view key, bool exceeded,
                        const auto& message) {
    if (!limit || !exceeded || (!limits_.stop && has_warned_of(key))) return;
    messages.push_back(fmt::format("{} is exceeded {}: {}", key, when(state), message()));
  };
  // With a negated comparison, so that NaN counts as exceeded.
  const LargestOverlap largest = limits_.overlap ? largest_overlap(state) : LargestOverlap{};
  look(limits_.overlap, "limits.overlap", !(largest.ratio <= limits_.overlap),
       [&] { return overlap_exceeded(state, largest); });
  const double error = energy_error_ratio(state, seen.energies);
  look(limits_.energy_error, "limits.energy_error", !(error <= limits_.energy_error),
       [&] { return energy_error_exceeded(error); });
  // Not negated: NaN, too few contacts to tell, does not count as exceeded.
  const double steps = limits_.steps_per_contact ? steps_per_contact(state) : 0.0;
  look(limits_.steps_per_contact, "limits.steps_per_contact", steps < limits_.steps_per_contact,
       [&] { return steps_too_few(steps); });
  const FastestGrain fastest = limits_.speed ? fastest_grain(state) : FastestGrain{};
  look(limits_.speed, "limits.speed", !(fastest.speed <= limits_.speed),
       [&] { return speed_exceeded(fastest); });
  if (!limits_.stop) warnings_.insert(warnings_.end(), messages.begin(), messages.end());
  return messages;
}

}  // namespace riesel::app
