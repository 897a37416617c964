#include "app/progress.hpp"

#include "app/terminal.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <cstddef>
#include <cstdio>
#include <string_view>

namespace riesel::app {

namespace {

using namespace std::chrono_literals;

constexpr auto between_updates_of_a_line = 200ms;
constexpr auto between_lines = 10s;

/// "hh:mm:ss"; hours may exceed 24.
std::string as_on_a_clock(std::chrono::seconds time) {
  const auto seconds = time.count();
  return fmt::format("{:02}:{:02}:{:02}", seconds / 3600, seconds / 60 % 60, seconds % 60);
}

/// Overwrites the previous line. Leaves the last column free, as a full line would wrap.
void show_in_place(const std::string& line) {
  const std::size_t room = terminal_width() - 1;
  tell("\r{:<{}}", std::string_view(line).substr(0, room), room);
}

}  // namespace

Progress::Progress(Verbosity verbosity)
    : quiet_(verbosity == Verbosity::quiet),
      terminal_(isatty(STDERR_FILENO) == 1),
      start_(Clock::now()),
      last_shown_(start_) {}

std::string Progress::time_left(double done) const {
  const double progress = done - done_at_start_;
  if (progress <= 0.0) return "--:--:--";
  const std::chrono::duration<double> spent = Clock::now() - start_;
  const auto left =
      std::chrono::duration_cast<std::chrono::seconds>(spent * (1.0 - done) / progress);
  return as_on_a_clock(left);
}

/// Since it was last shown.
bool Progress::has_rested() const {
  return Clock::now() - last_shown_
         >= (terminal_ ? Clock::duration(between_updates_of_a_line) : between_lines);
}

bool Progress::is_due() const { return !quiet_ && (done_at_start_ < 0.0 || has_rested()); }

void Progress::show(double done, const std::string& text) {
  if (!is_due()) return;
  if (done_at_start_ < 0.0) done_at_start_ = done;
  if (!has_rested()) return;
  last_shown_ = Clock::now();
  const std::string line =
      fmt::format("{:5.1f} %  {}  {} left", 100.0 * done, text, time_left(done));
  if (terminal_)
    show_in_place(line);
  else
    tell("{}\n", line);
  std::fflush(stderr);
  line_open_ = terminal_;
}

void Progress::finish() {
  if (line_open_) tell("\n");
  line_open_ = false;
}

}  // namespace riesel::app
