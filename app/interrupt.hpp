// SIGINT, SIGTERM and SIGHUP are requests to end. A command that has something to save writes a
// checkpoint first, at the next occasion; a second signal ends it at once, except a SIGHUP, or a
// SIGTERM within a few seconds, as one request may send several of these. A command that has
// nothing to save ends at once.
#pragma once

namespace riesel::app {

/// From now on a signal ends the program with a message and the status 128 + signal. For commands
/// that have no results to lose; no file is left half-written, as files are replaced as a whole.
void end_on_interrupts();

/// From now on the first signal is only noted (interrupting_signal()), and a reader of the output
/// that goes away does not end the program (SIGPIPE).
void catch_interrupts();

/// From now on signals have their default effect. Safe between fork and exec.
void forget_interrupts();

/// The first signal since catch_interrupts(), or 0.
int interrupting_signal();

}  // namespace riesel::app
