#include "engine/stopping_rule.hpp"

#include "engine/steady_state.hpp"

#include <cmath>
#include <cstddef>

namespace riesel {
namespace {

/// Of a number of samples: the last look at fewer samples, and the first at as many or more.
struct Looks {
  std::size_t before = 0;
  std::size_t next = 100;
};

Looks looks_around(std::size_t samples) {
  Looks looks;
  while (looks.next < samples) looks = {.before = looks.next, .next = looks.next + looks.next / 4};
  return looks;
}

}  // namespace

bool is_time_to_look(std::size_t samples) { return looks_around(samples).next == samples; }

bool is_precise(std::span<const double> velocities, double relative_error,
                std::optional<double> free_fall_gain) {
  const auto pleases = [&](std::span<const double> series) {
    const SteadyState state = assess_steady_state(series, free_fall_gain);
    return state.verdict == SteadyVerdict::steady
           && state.error <= relative_error * std::abs(state.mean);
  };
  const auto [before, next] = looks_around(velocities.size());
  return next == velocities.size() && pleases(velocities) && pleases(velocities.first(before));
}

}  // namespace riesel
