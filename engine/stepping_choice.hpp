// Plain stepping or flights, on one thread or on several, together or apart: what is fastest here
// and now?
//
// It depends on the state, the size of the system, the machine and what else runs on it. The bits
// do not depend on the choice, so the clock may decide: each way is tried for one piece of the run,
// twice at its beginning, and now and then later. These later trials take a few per cent of the
// time at most, less and less as long as they find nothing. A machine has bad moments, in which any
// way looks slow: another way must win twice, with a piece of the preferred one in between. Only at
// the beginning, when each trial is much of what has been done, one is enough if it is clear.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace riesel {

/// How steps are done.
struct Way {
  bool by_flights;
  int threads;
  bool apart = false;  ///< each with a part of its own

  bool operator==(const Way&) const = default;
};

class SteppingChoice {
public:
  /// At least one; the first is what to begin with.
  explicit SteppingChoice(std::vector<Way> ways)
      : ways_(std::move(ways)), paces_(ways_.size(), 0.0), looks_(ways_.size(), first_looks) {
    looks_.front() = 0;
  }

  /// How the next piece is to be done.
  Way way() const { return ways_[next()]; }
  /// s per step, the last time that steps were done that way; 0 if they never were.
  double pace() const { return paces_[next()]; }
  Way preferred() const { return ways_[preferred_]; }
  /// Whether there is anything to choose.
  bool open() const { return ways_.size() > 1; }
  /// Whether each has been looked at as often as at the beginning.
  bool past_first_looks() const {
    return std::all_of(looks_.begin(), looks_.end(), [](int looks) { return looks == 0; });
  }

  /// A piece of so many steps was done that way, in `seconds`; `preparation` (s) came before it.
  void note(std::int64_t steps, double seconds, double preparation) {
    paces_[next()] = seconds / static_cast<double>(steps);
    if (trying_)
      conclude(seconds + 2.0 * preparation);
    else
      go_on(seconds);
  }

private:
  static constexpr int first_looks = 2;
  static constexpr double shortest_patience = 0.25, longest_patience = 60.0;  // s
  /// Time between trials over the time of one.
  static constexpr double patience_per_cost = 40.0;
  /// So much faster another way must be.
  static constexpr double worthwhile = 0.95;
  /// One of two ways that takes so many times as long as the other needs no second look.
  static constexpr double clear = 1.5;

  std::size_t next() const { return trying_ ? tried_ : preferred_; }

  void go_on(double seconds) {
    since_trial_ += seconds;
    trying_ = won_once_ || !past_first_looks() || (open() && since_trial_ >= patience_);
    if (trying_ && !won_once_) tried_ = next_to_try();
  }

  /// All others in turn, or those that are still to be looked at.
  std::size_t next_to_try() const {
    const bool first_looks_only = !past_first_looks();
    std::size_t other = tried_;
    do other = (other + 1) % ways_.size();
    while (other == preferred_ || (first_looks_only && looks_[other] == 0));
    return other;
  }

  void conclude(double cost) {
    const double pace = paces_[tried_], usual = paces_[preferred_];
    trying_ = false;
    since_trial_ = 0.0;
    const bool faster = pace < worthwhile * usual;
    const bool at_once =
        looks_[tried_] > 0 && std::max(pace, usual) > clear * std::min(pace, usual);
    won_once_ = faster && !won_once_ && !at_once;
    if (won_once_) return;
    looks_[tried_] = at_once || faster ? 0 : std::max(looks_[tried_] - 1, 0);
    if (faster) {
      preferred_ = tried_;
      patience_ = std::max(shortest_patience, patience_per_cost * cost);
    } else {
      patience_ = std::max(std::min(2.0 * patience_, longest_patience), patience_per_cost * cost);
    }
  }

  std::vector<Way> ways_;
  std::size_t preferred_ = 0, tried_ = 0;  // indices of ways
  std::vector<double> paces_;              // of ways, s per step, of the last piece; 0: of none
  std::vector<int> looks_;                 // at ways, at the beginning, that are still to come
  bool trying_ = false;
  bool won_once_ = false;                // so has the way that was tried last
  double since_trial_ = 0.0;             // s
  double patience_ = shortest_patience;  // s, until the next trial
};

}  // namespace riesel
