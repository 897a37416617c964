// When a run has to stop so that its state is saved before its allowed real time is over.
#pragma once

#include "app/walltime.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>

namespace riesel::app {

class TimeLimit {
public:
  /// `seconds` since the start of the program; nothing: there is no limit.
  explicit TimeLimit(std::optional<double> seconds) : seconds_(seconds) {}

  /// Notes how long (s) stepping took between two looks at the clock (a piece), or writing a
  /// checkpoint and `rows` rows of the series (a save).
  void note_piece(double seconds) { longest_piece_ = std::max(longest_piece_, seconds); }
  void note_save(double seconds, std::int64_t rows) {
    longest_save_ = std::max(longest_save_, seconds);
    rows_saved_ = rows;
  }

  /// Whether to stop now: another piece and a save, each taken twice as long as the longest so far,
  /// would not fit.
  bool is_reached() const {
    constexpr double reserve = 2.0;
    return seconds_
           && seconds_since_start_of_program() + reserve * (longest_piece_ + longest_save_)
                  > *seconds_;
  }

  /// Whether to save now, only to learn how long it takes: at first, and whenever the rows have
  /// doubled. With twice the rows a save may take twice as long, which the reserve above covers.
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
