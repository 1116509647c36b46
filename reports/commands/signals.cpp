#include "reports/commands/signals.h"

#include <csignal>

namespace cli {
namespace {

// A signal can reach nothing but these.
std::atomic<bool> stop = false;
volatile std::sig_atomic_t received = 0;

extern "C" void on_signal(int number) {
  received = number;
  stop.store(true);
}

}  // namespace

void listen_to_signals() {
  struct sigaction action = {};
  action.sa_handler = on_signal;
  action.sa_flags = static_cast<int>(SA_RESTART | SA_RESETHAND);
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before = {};
    const bool ignored = sigaction(number, nullptr, &before) == 0 && before.sa_handler == SIG_IGN;
    if (ignored && number == SIGHUP) continue;  // nohup; shells without jobs ignore SIGINT for what runs behind
    sigaction(number, &action, nullptr);
  }
}

const std::atomic<bool>& stop_asked() { return stop; }

int exit_code_of_signal() { return 128 + received; }

}  // namespace cli
