// Each run of a sweep is a process of its own, so that the others and the sweep go on whatever it
// does, even if it crashes.
#pragma once

#include "io/file_error.hpp"

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace riesel::app {

/// A program that ignores SIGCHLD passes that on to the programs that it starts, which then cannot
/// learn how their own children end. From now on this program can.
void heed_ends_of_children();

/// How a process ended.
struct ProcessEnd {
  int status = 0;  ///< exit status, if no signal ended it
  int signal = 0;  ///< the signal that ended it, or 0

  bool is_success() const { return status == 0 && signal == 0; }
};

/// `wait_status`: what waitpid() tells of a process that has ended.
ProcessEnd end_of(int wait_status);

/// The system has no room for another process: no run can be started.
class NoProcess : public io::FileError {
public:
  explicit NoProcess(const io::FileError& error) : FileError(error) {}
};

/// This program, started again with other arguments. Signals of the terminal do not reach it: its
/// parent has to pass them on with send(). If its parent dies, it gets SIGTERM.
class ChildProcess {
public:
  /// What it prints is appended to `log`. Throws io::FileError if `log` cannot be written,
  /// NoProcess if no process can be started.
  ChildProcess(const std::vector<std::string>& arguments, const std::filesystem::path& log);
  /// Asks a process that still runs to stop (SIGTERM), unless it has been sent a signal before: a
  /// run takes the second one for impatience. Waits for its end.
  ~ChildProcess();

  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  ChildProcess(ChildProcess&&) = delete;
  ChildProcess& operator=(ChildProcess&&) = delete;

  /// How it ended; nothing while it runs. Does not wait.
  std::optional<ProcessEnd> end();

  /// Does nothing once end() has returned a value.
  void send(int signal);

private:
  pid_t id_;
  bool has_been_sent_a_signal_ = false;
  std::optional<ProcessEnd> end_;
};

}  // namespace riesel::app
