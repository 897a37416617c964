// Looks whether a run has left the range that its user allows.
#pragma once

#include "engine/observables.hpp"
#include "engine/state.hpp"
#include "scenarios/run_limits.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace riesel::app {

class LimitWatch {
public:
  /// `warnings` are those that an earlier part of the run has given.
  LimitWatch(const scenarios::RunLimits& limits, std::vector<std::string> warnings);

  bool stops() const { return limits_.stop; }

  /// All that were given so far, one for each limit. None stops the run.
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// What exceeds a limit for the first time, one sentence each: which, when, how much, which
  /// grains, and what to do. Unless they stop the run they are warnings from now on, and not new
  /// any more. `seen` is of `state`.
  std::vector<std::string> newly_exceeded(const State& state, const Observables& seen);

private:
  bool has_warned_of(std::string_view key) const;

  scenarios::RunLimits limits_;
  std::vector<std::string> warnings_;
};

}  // namespace riesel::app
