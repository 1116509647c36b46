#include "reports/commands/terminal.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <string_view>

namespace cli {
namespace {

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

int terminal_width() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 100;
}

}  // namespace

bool coloured(int file) {
  const char* no_colour = std::getenv("NO_COLOR");
  const char* kind = std::getenv("TERM");
  return isatty(file) != 0 && (!no_colour || *no_colour == 0) && kind && std::string_view(kind) != "dumb";
}

dem::ProgressPrinter progress_printer(bool quiet, bool json) {
  using Mode = dem::ProgressPrinter::Mode;
  const Mode mode = quiet ? Mode::quiet : json ? Mode::json : isatty(STDERR_FILENO) != 0 ? Mode::bar : Mode::lines;
  return {std::cerr, mode, seconds_now, terminal_width()};
}

dem::StudyListener progress_listener(dem::ProgressPrinter& progress) {
  dem::StudyListener listener;
  listener.begin = [&](const std::string& id, int number, int total, const std::string& why) {
    progress.begin(id, number);
    progress.say(fmt::format("{} ({}/{}): starting, {}", id, number, total, why));
  };
  listener.progress = [&](const std::string& id, const dem::Progress& now) { progress.update(id, now); };
  listener.note = [&](const std::string& note) { progress.say(note); };
  listener.end = [&](const dem::CaseOutcome& outcome) {
    using dem::CaseState;
    progress.end(outcome.id);
    switch (outcome.state) {
      case CaseState::kept:
        return progress.say(outcome.id + ": kept, nothing it depends on has changed");
      case CaseState::simulated:
        return progress.say(outcome.id + ": done in " + dem::duration_text(outcome.seconds));
      case CaseState::left_out:
        return;
      case CaseState::failed:
      case CaseState::missing:
        return progress.say(outcome.id + ": failed: " + outcome.error);
    }
  };
  return listener;
}

}  // namespace cli
