// Runs of a sweep are processes of their own: whatever one of them does, crash included, the others
// and the sweep go on.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace riesel::app {

/// Whoever ignores the ends of its children (SIGCHLD) hands that on to the programs that it starts,
/// and those could not learn how theirs end. From now on this one can.
void heed_ends_of_children();

/// How a process ended.
struct ProcessEnd {
  int status = 0;  ///< exit status, if no signal ended it
  int signal = 0;  ///< the signal that ended it, or 0
};

/// This program, called with other arguments. Signals of the terminal do not reach it: whoever
/// started it passes them on. Should its parent die, it gets SIGTERM.
class ChildProcess {
public:
  /// What it prints is appended to `log`. Throws io::FileError if that cannot be written, or if
  /// there can be no more processes.
  ChildProcess(const std::vector<std::string>& arguments, const std::filesystem::path& log);
  /// Stops a process that still runs, politely, and waits for its end.
  ~ChildProcess();

  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  ChildProcess(ChildProcess&&) = delete;
  ChildProcess& operator=(ChildProcess&&) = delete;

  /// Nothing while it runs.
  std::optional<ProcessEnd> end();

  void send(int signal) const;

private:
  pid_t id_;
  std::optional<ProcessEnd> end_;
};

}  // namespace riesel::app
