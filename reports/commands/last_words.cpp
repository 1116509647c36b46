#include "reports/commands/last_words.h"

#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>

#include "engine/core/errors.h"

namespace cli {
namespace {

std::atomic<bool> ours = false;    // the exit that is under way
std::atomic<bool> spoken = false;  // several threads may be out of memory at once

// Nothing here may need memory.
void say(const char* words) {
  const std::size_t size = std::strlen(words);
  if (::write(STDERR_FILENO, words, size) < 0) return;  // nobody listens
}

[[noreturn]] void end_with(const char* words, const char* more = "") {
  if (!spoken.exchange(true)) {
    for (const char* part : {"\ndem-report: ", words, more, "\n"}) say(part);
  }
  std::_Exit(3);
}

[[noreturn]] void on_terminate() {
  if (const std::exception_ptr error = std::current_exception()) {
    try {
      std::rethrow_exception(error);
    } catch (const std::bad_alloc&) {
      end_with(
          "out of memory; the state of the cases is kept as of their last checkpoints: try a smaller --scale or "
          "fewer --threads");
    } catch (const dem::EnvironmentError& failure) {
      end_with(failure.what());
    } catch (const std::exception& failure) {
      end_with("internal error: ", failure.what());
    } catch (...) {
    }
  }
  end_with("internal error: ended without a reason");
}

void on_exit() {
  if (ours) return;
  end_with(
      "a library ended the program (see above); the machine has no more threads or memory for it: try fewer "
      "--threads, or raise the limits (ulimit -u, ulimit -v); the last checkpoints are kept");
}

}  // namespace

void prepare_last_words() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  std::set_terminate(on_terminate);
  std::atexit(on_exit);
}

int leave_with(int code) {
  ours = true;
  return code;
}

}  // namespace cli
