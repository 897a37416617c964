#include "engine/stopping_rule.hpp"

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

bool is_precise(const FlowSeries& flow, double relative_error) {
  const auto pleases = [&](const FlowSeries& series) {
    const SteadyState state = assess_flow(series);
    return state.verdict == SteadyVerdict::steady
           && state.error <= relative_error * std::abs(state.mean);
  };
  const auto [before, next] = looks_around(flow.judged.size());
  return next == flow.judged.size() && pleases(flow) && pleases(flow.first(before));
}

}  // namespace riesel
