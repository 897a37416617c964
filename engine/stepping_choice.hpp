// Plain stepping or flights: which is faster here and now?
//
// It depends on the state, the size of the system, the machine and what else runs on it. The bits
// do not depend on the choice, so the clock may decide: now and then the other way is tried for
// one piece of the run. Trials take a few per cent of the time at most, less and less as long as
// they find nothing.
#pragma once

#include <algorithm>
#include <cstdint>

namespace riesel {

class SteppingChoice {
public:
  explicit SteppingChoice(bool flights_first) : flights_preferred_(flights_first) {}

  /// How the next piece is to be done.
  bool by_flights() const { return flights_preferred_ != trying_; }

  /// A piece of so many steps was done that way, in `seconds`; `preparation` (s) came before it.
  void note(std::int64_t steps, double seconds, double preparation) {
    const double pace = seconds / static_cast<double>(steps);
    if (trying_)
      conclude(pace, seconds + 2.0 * preparation);
    else
      go_on(pace, seconds);
  }

private:
  static constexpr double shortest_patience = 0.25, longest_patience = 60.0;  // s
  /// Time between trials over the time of one.
  static constexpr double patience_per_cost = 40.0;
  /// So much faster the other way must be.
  static constexpr double worthwhile = 0.95;

  void go_on(double pace, double seconds) {
    pace_ = pace;
    since_trial_ += seconds;
    trying_ = since_trial_ >= patience_;
  }

  void conclude(double pace, double cost) {
    trying_ = false;
    since_trial_ = 0.0;
    if (pace < worthwhile * pace_) {
      flights_preferred_ = !flights_preferred_;
      patience_ = std::max(shortest_patience, patience_per_cost * cost);
    } else {
      patience_ = std::max(std::min(2.0 * patience_, longest_patience), patience_per_cost * cost);
    }
  }

  bool flights_preferred_, trying_ = false;
  double pace_ = 0.0;                    // s per step, of the last piece done the preferred way
  double since_trial_ = 0.0;             // s
  double patience_ = shortest_patience;  // s, until the next trial
};

}  // namespace riesel
