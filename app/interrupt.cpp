#include "app/interrupt.hpp"

#include <csignal>
#include <initializer_list>
#include <unistd.h>

namespace riesel::app {

namespace {

volatile std::sig_atomic_t received = 0;

void on_signal(int signal) {
  if (received != 0) _exit(128 + signal);
  received = signal;
}

}  // namespace

void catch_interrupts() {
  for (const int signal : {SIGINT, SIGTERM}) {
    struct sigaction action = {};
    action.sa_handler = on_signal;
    sigaction(signal, &action, nullptr);
  }
}

int interrupting_signal() { return received; }

}  // namespace riesel::app
