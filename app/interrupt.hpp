// SIGINT, SIGTERM and SIGHUP as a polite request: what has something to save stops at the next
// occasion, after a checkpoint, and a second signal ends it at once: but not SIGHUP, nor SIGTERM
// within some seconds, which may come several times of one wish. What has nothing to save ends at
// once.
#pragma once

namespace riesel::app {

/// From now on a signal ends the program with a message and the status 128 + signal. For whatever
/// has no results that could be lost: files are replaced as a whole.
void end_on_interrupts();

/// From now on the first signal only asks for the end, and whoever has read its messages may go
/// (SIGPIPE).
void catch_interrupts();

/// From now on signals do what they do to any program. Safe between fork and exec.
void forget_interrupts();

/// The signal that has asked for the end, or 0.
int interrupting_signal();

}  // namespace riesel::app
