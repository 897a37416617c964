// Chooses the fastest way of stepping: plain or flights, on one thread or on several, together or
// apart.
//
// Which is fastest depends on the state, the size of the system, the machine and what else runs on
// it. The results do not depend on the choice, so the clock may decide: each way is tried for one
// piece of the run, twice at its beginning and again from time to time. These later trials take a
// few per cent of the time at most, and become rarer as long as they find nothing. As any way looks
// slow when the machine is busy for a moment, another way must win twice, with a piece of the
// preferred one in between. Only at the beginning, when each trial is much of what has been done,
// one trial is enough if the difference is clear.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace riesel {

/// What the choice is between.
struct Way {
  bool by_flights;
  int threads;
  bool apart = false;  ///< each with a part of its own

  bool operator==(const Way&) const = default;
};

class SteppingChoice {
public:
  /// Chooses among `ways`, of which there must be one at least; begins with the first.
  explicit SteppingChoice(std::vector<Way> ways)
      : ways_(std::move(ways)), paces_(ways_.size(), 0.0), looks_(ways_.size(), first_looks) {
    looks_.front() = 0;
  }

  /// How the next piece is to be done.
  Way way() const { return ways_[next()]; }
  /// s per step of the last piece that was done that way; 0 if there was none.
  double pace() const { return paces_[next()]; }
  /// The fastest way so far.
  Way preferred() const { return ways_[preferred_]; }
  /// Whether there is more than one way.
  bool open() const { return ways_.size() > 1; }
  /// Whether the trials at the beginning are over.
  bool past_first_looks() const {
    return std::all_of(looks_.begin(), looks_.end(), [](int looks) { return looks == 0; });
  }

  /// To be called when a piece of `steps` > 0 steps was done as way() said: it took `seconds`, and
  /// preparing it took `preparation` (s). Decides how the next piece is done.
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
  /// Another way is faster if its time per step is less than this part of that of the preferred
  /// one.
  static constexpr double worthwhile = 0.95;
  /// Between two ways, one of which takes this many times as long as the other, one trial is
  /// enough.
  static constexpr double clear = 1.5;

  std::size_t next() const { return trying_ ? tried_ : preferred_; }

  void go_on(double seconds) {
    since_trial_ += seconds;
    trying_ = won_once_ || !past_first_looks() || (open() && since_trial_ >= patience_);
    if (trying_ && !won_once_) tried_ = next_to_try();
  }

  /// Goes through all other ways in turn; at the beginning through those that still need a trial.
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
  std::vector<double> paces_;              // by way: s per step of the last piece; 0: none so far
  std::vector<int> looks_;                 // by way: trials at the beginning still to be done
  bool trying_ = false;                    // the next piece is a trial of tried_
  bool won_once_ = false;                  // tried_ was faster, and will be tried once more
  double since_trial_ = 0.0;               // s
  double patience_ = shortest_patience;    // s, until the next trial
};

}  // namespace riesel
