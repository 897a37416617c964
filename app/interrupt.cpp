#include "app/interrupt.hpp"

#include <atomic>
#include <csignal>
#include <cstdint>
#include <ctime>
#include <initializer_list>
#include <string_view>
#include <unistd.h>

namespace riesel::app {

namespace {

// Atomic, as the handler may run on any thread.
std::atomic<int> received = 0;
std::atomic<std::int64_t> received_at = 0;  // s
static_assert(std::atomic<int>::is_always_lock_free);
static_assert(std::atomic<std::int64_t>::is_always_lock_free);

/// s, of a monotonic clock; safe in a signal handler.
std::int64_t now() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return time.tv_sec;
}

/// Makes only calls that are safe in a signal handler.
void end(int signal) {
  constexpr std::string_view message =
      "\nriesel: interrupted; no file is left half-written. Run the command again to start over\n";
  const ssize_t written = write(STDERR_FILENO, message.data(), message.size());
  static_cast<void>(written);
  _exit(128 + signal);
}

/// One request may arrive as several signals. A terminal that is closed sends SIGHUP itself and
/// through its shell. A batch system or a shutdown sends SIGTERM to all processes: one comes
/// directly, one from the sweep that has started this run, and one as that ends. SIGINT comes just
/// once for each press of the keys.
void remember(int signal) {
  constexpr std::int64_t same_wish = 5;  // s
  if (received == 0) {
    received_at = now();
    received = signal;
    return;
  }
  const bool again = signal == SIGHUP || (signal == SIGTERM && now() - received_at < same_wish);
  if (!again) _exit(128 + signal);
}

void on(int signal, void (*act)(int)) {
  struct sigaction action = {};
  action.sa_handler = act;
  sigaction(signal, &action, nullptr);
}

/// nohup, for instance, has SIGHUP ignored.
bool is_ignored(int signal) {
  struct sigaction action = {};
  return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

void on_interrupts(void (*act)(int)) {
  for (const int signal : {SIGINT, SIGTERM}) on(signal, act);
  if (!is_ignored(SIGHUP)) on(SIGHUP, act);
}

}  // namespace

void forget_interrupts() {
  on_interrupts(SIG_DFL);
  on(SIGPIPE, SIG_DFL);
}

void end_on_interrupts() { on_interrupts(end); }

void catch_interrupts() {
  on_interrupts(remember);
  on(SIGPIPE, SIG_IGN);
}

int interrupting_signal() { return received; }

}  // namespace riesel::app
