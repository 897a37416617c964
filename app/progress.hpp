// Tells the user how far a run is: one line that renews itself on a terminal, a line now and then
// elsewhere. All of it goes to standard error, so that standard output holds results only.
#pragma once

#include "app/clock.hpp"
#include "app/verbosity.hpp"

#include <chrono>
#include <string>

namespace riesel::app {

class Progress {
public:
  explicit Progress(Verbosity verbosity);

  /// `done` from 0 to 1; `text` says what is worth knowing now.
  void show(double done, const std::string& text);
  /// Ends the line, before other text is printed.
  void finish();

private:
  std::string time_left(double done) const;

  bool quiet_, terminal_;
  Clock::time_point start_, last_shown_;
  double done_at_start_ = -1.0;
  bool line_open_ = false;
};

}  // namespace riesel::app
