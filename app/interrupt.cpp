#include "app/interrupt.hpp"

#include <atomic>
#include <csignal>
#include <initializer_list>
#include <string_view>
#include <unistd.h>

namespace riesel::app {

namespace {

/// The handler runs on any thread of the program.
std::atomic<int> received = 0;
static_assert(std::atomic<int>::is_always_lock_free);

/// Only calls that a signal handler may make.
void end(int signal) {
  constexpr std::string_view message =
      "\nriesel: interrupted, nothing is left half-written; call it again to start anew\n";
  const ssize_t written = write(STDERR_FILENO, message.data(), message.size());
  static_cast<void>(written);
  _exit(128 + signal);
}

/// A terminal that goes may say so twice, through its shell and by itself.
void remember(int signal) {
  if (received == 0)
    received = signal;
  else if (signal != SIGHUP)
    _exit(128 + signal);
}

void on(int signal, void (*act)(int)) {
  struct sigaction action = {};
  action.sa_handler = act;
  sigaction(signal, &action, nullptr);
}

/// As nohup asks for.
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
