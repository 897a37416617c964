// Looks whether a run has left the range that its user allows.
#pragma once

#include "engine/observables.hpp"
#include "engine/state.hpp"
#include "scenarios/run_limits.hpp"

#include <string>
#include <vector>

namespace riesel::app {

class LimitWatch {
public:
  explicit LimitWatch(const scenarios::RunLimits& limits) : limits_(limits) {}

  bool stops() const { return limits_.stop; }

  /// What exceeds a limit for the first time, one sentence each: how much, when, which grains, and
  /// what to do. `seen` is of `state`.
  std::vector<std::string> newly_exceeded(const State& state, const Observables& seen);

private:
  scenarios::RunLimits limits_;  // those that nothing has exceeded yet
};

}  // namespace riesel::app
