#pragma once
// Signals that ask the program to stop.
#include <atomic>

namespace cli {

/// From now on the first SIGINT, SIGTERM or SIGHUP asks the running cases to write their checkpoints and stop, and drawing
/// and printing to end; a second one of the same kind ends the program at once. An ignored SIGHUP (nohup) stays so.
void listen_to_signals();

/// True once a signal asked for it.
const std::atomic<bool>& stop_asked();

/// The exit code of a program that a signal stopped: 128 and the number of the signal.
int exit_code_of_signal();

}  // namespace cli
