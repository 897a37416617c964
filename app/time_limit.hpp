// When a run has to stop, so that it has saved before the time on the clock that it may take is
// over.
#pragma once

#include "app/walltime.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>

namespace riesel::app {

class TimeLimit {
public:
  /// `seconds` from the start of the program. Without them there is no limit.
  explicit TimeLimit(std::optional<double> seconds) : seconds_(seconds) {}

  /// A piece of the way took so long (s), and a save with so many rows of the series.
  void note_piece(double seconds) { longest_piece_ = std::max(longest_piece_, seconds); }
  void note_save(double seconds, std::int64_t rows) {
    longest_save_ = std::max(longest_save_, seconds);
    rows_saved_ = rows;
  }

  /// With a reserve for what comes before the end: a piece of the way, and what it takes to save.
  bool is_reached() const {
    constexpr double reserve = 2.0;
    return seconds_
           && seconds_since_start_of_program() + reserve * (longest_piece_ + longest_save_)
                  > *seconds_;
  }

  /// To know how long it takes, and again when there are twice as many rows, which may take twice
  /// as long: that is the reserve.
  bool asks_to_save(std::int64_t rows) const {
    constexpr std::int64_t few = 1000;
    return seconds_ && (longest_save_ == 0.0 || rows > 2 * std::max(few, rows_saved_));
  }

private:
  std::optional<double> seconds_;
  double longest_piece_ = 0.0;  // s, of stepping between two looks at the clock
  double longest_save_ = 0.0;   // s
  std::int64_t rows_saved_ = 0;
};

}  // namespace riesel::app
