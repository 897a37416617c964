// SIGINT and SIGTERM as a polite request: the run stops at the next occasion, after a checkpoint. A
// second signal ends the program at once.
#pragma once

namespace riesel::app {

void catch_interrupts();

/// The signal that has asked for the end, or 0.
int interrupting_signal();

}  // namespace riesel::app
