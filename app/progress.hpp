// Tells the user how far a run is: on a terminal one line that is updated in place, elsewhere a new
// line now and then. Goes to standard error, so that standard output holds results only.
#pragma once

#include "app/clock.hpp"
#include "app/verbosity.hpp"

#include <chrono>
#include <string>

namespace riesel::app {

class Progress {
public:
  explicit Progress(Verbosity verbosity);
  ~Progress() { finish(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  Progress(Progress&&) = delete;
  Progress& operator=(Progress&&) = delete;

  /// Whether show() would do anything now: for those who have to count first what it is to show.
  bool is_due() const;
  /// `done`: from 0 to 1; `text`: what else to show.
  void show(double done, const std::string& text);
  /// Ends the line; to be called before other text is printed.
  void finish();

private:
  bool has_rested() const;
  std::string time_left(double done) const;

  bool quiet_, terminal_;
  Clock::time_point start_, last_shown_;
  double done_at_start_ = -1.0;
  bool line_open_ = false;
};

}  // namespace riesel::app
