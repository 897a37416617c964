// How many steps a run makes before it looks at the clock and for signals again: as many as take
// about a second, on a machine that is busy with other work or has fewer cores than the run has
// threads, too. Shorter pieces would cost large systems much, as each ends with a complete state.
#pragma once

#include <algorithm>
#include <cstdint>

namespace riesel::app {

class Pace {
public:
  /// The next piece of the way, at most: 1 or more.
  std::int64_t steps() const { return steps_; }

  /// A piece of so many steps took so long. The next is at most twice as long as has been tried.
  void note(std::int64_t steps, double seconds) {
    constexpr double aim = 1.0;  // s
    const auto most = std::max(steps_, 2 * steps);
    const double fitting = aim / std::max(seconds, shortest_time) * static_cast<double>(steps);
    steps_ =
        std::clamp<std::int64_t>(static_cast<std::int64_t>(std::min(fitting, most_steps)), 1, most);
  }

private:
  static constexpr double shortest_time = 1e-9;  // s, that a clock tells
  static constexpr double most_steps = 1e9;

  std::int64_t steps_ = 16;  // of a large system on a slow machine: a moment
};

}  // namespace riesel::app
