// Watches whether a run leaves the range that its user allows.
#pragma once

#include "engine/observables.hpp"
#include "engine/state.hpp"
#include "scenarios/run_limits.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace riesel::app {

/// The key of the limit that a message of LimitWatch is about.
std::string_view key_of_limit(std::string_view message);

class LimitWatch {
public:
  /// `warnings` are those given before the run was resumed.
  LimitWatch(const scenarios::RunLimits& limits, std::vector<std::string> warnings);

  bool stops() const { return limits_.stop; }

  /// All warnings given so far, at most one for each limit. None of them stops the run.
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// A sentence for each limit that is exceeded for the first time: which, when, by how much, by
  /// which grains, and what to do. Unless stops(), they are then among warnings() and not returned
  /// again. `seen` are the observables of `state`.
  std::vector<std::string> newly_exceeded(const State& state, const Observables& seen);

private:
  bool has_warned_of(std::string_view key) const;

  scenarios::RunLimits limits_;
  std::vector<std::string> warnings_;
};

}  // namespace riesel::app
