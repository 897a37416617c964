// How many steps a run makes before it looks at the clock and for signals again: as many as take
// about a second, also on a machine that is busy with other work or has fewer cores than the run
// has threads. Shorter pieces would slow down large systems, as each ends with a complete state.
#pragma once

#include <algorithm>
#include <cstdint>

namespace riesel::app {

class Pace {
public:
  /// The largest number of steps for the next piece; at least 1.
  std::int64_t steps() const { return steps_; }

  /// Notes that a piece of `steps` took `seconds`. The next may be at most twice as long as the
  /// longest that has been tried.
  void note(std::int64_t steps, double seconds) {
    constexpr double aim = 1.0;  // s
    const auto most = std::max(steps_, 2 * steps);
    const double fitting = aim / std::max(seconds, shortest_time) * static_cast<double>(steps);
    steps_ =
        std::clamp<std::int64_t>(static_cast<std::int64_t>(std::min(fitting, most_steps)), 1, most);
  }

private:
  static constexpr double shortest_time = 1e-9;  // s, that the clock resolves
  static constexpr double most_steps = 1e9;

  std::int64_t steps_ = 16;  // soon done even for a large system on a slow machine
};

}  // namespace riesel::app
