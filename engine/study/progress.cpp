#include "engine/study/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>

#include "engine/core/text.h"

namespace dem {
namespace {

constexpr double bar_interval = 0.1;  // s between redraws: smooth, and nothing beside a step
constexpr double line_interval = 10;  // s between plain lines at least
constexpr double line_share = 0.1;    // of the case between plain lines ...
constexpr double line_silence = 60;   // ... or so many seconds: no silent hours

std::string bar(double fraction) {
  constexpr int cells = 20;
  const int full = std::clamp(static_cast<int>(fraction * cells), 0, cells);
  return "[" + std::string(static_cast<std::size_t>(full), '#') +
         std::string(static_cast<std::size_t>(cells - full), '.') + "] ";
}

/// As JSON writes it.
std::string quoted(const std::string& text) {
  std::string all = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') all += '\\';
    if (static_cast<unsigned char>(c) < 0x20) {
      all += fmt::format("\\u{:04x}", static_cast<unsigned>(static_cast<unsigned char>(c)));
    } else {
      all += c;
    }
  }
  return all + "\"";
}

}  // namespace

std::string duration_text(double seconds) {
  const auto whole = static_cast<long>(std::lround(std::max(seconds, 0.0)));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

ProgressPrinter::ProgressPrinter(std::ostream& out, Mode mode, std::function<double()> seconds, int width)
    : out_(out), mode_(mode), seconds_(std::move(seconds)), width_(width) {}

void ProgressPrinter::start(int total) {
  total_ = total;
  done_ = 0;
  running_.clear();
}

void ProgressPrinter::begin(const std::string& id, int number) {
  running_.push_back({.id = id, .number = number, .shown_time = seconds_()});
  tell("begin", fmt::format(R"("case":{},"number":{},"of":{})", quoted(id), number, total_));
}

void ProgressPrinter::end(const std::string& id) {
  ++done_;
  tell("end", fmt::format(R"("case":{},"done":{},"of":{})", quoted(id), done_, total_));
  std::erase_if(running_, [&](const Running& running) { return running.id == id; });
}

void ProgressPrinter::update(const std::string& id, const Progress& progress) {
  if (mode_ == Mode::quiet) return;
  const auto running = std::ranges::find(running_, id, &Running::id);
  if (running == running_.end()) return;
  running->latest = progress;
  if (running->first_fraction < 0) {
    running->first_fraction = running->shown_fraction = progress.fraction;
    running->first_time = seconds_();
  }
  if (mode_ == Mode::bar) {
    draw_bar();
  } else if (mode_ == Mode::json) {
    if (seconds_() - running->shown_time < 1) return;
    running->shown_time = seconds_();
    const double left = seconds_left(*running);
    tell("progress", fmt::format(R"("case":{},"stage":{},"fraction":{:.4f})", quoted(id), quoted(progress.stage),
                                 progress.fraction) +
                         (std::isfinite(left) ? fmt::format(R"(,"seconds_left":{:.0f})", left) : ""));
  } else {
    write_line(*running);
  }
}

void ProgressPrinter::draw_bar() {
  const double now = seconds_();
  if (now - bar_time_ < bar_interval && bar_shown_) return;
  double cases = running_.size() == 1 ? 0 : done_;
  for (const Running& running : running_) cases += running.latest.fraction;
  std::string text = running_.size() == 1 ? bar(cases) + line(running_[0]) : bar(cases / total_) + study_line();
  if (static_cast<int>(text.size()) > width_ - 1) text.resize(static_cast<std::size_t>(std::max(width_ - 1, 0)));
  out_ << "\r\033[K" << text << std::flush;
  bar_shown_ = true;
  bar_time_ = now;
}

void ProgressPrinter::write_line(Running& running) {
  const double now = seconds_();
  const double silent = now - running.shown_time;
  const bool moved = running.latest.fraction - running.shown_fraction >= line_share || silent >= line_silence;
  if (silent < line_interval || !moved) return;
  out_ << line(running) << std::endl;
  running.shown_fraction = running.latest.fraction;
  running.shown_time = now;
}

void ProgressPrinter::tell(const std::string& event, const std::string& fields) {
  if (mode_ != Mode::json) return;
  out_ << fmt::format(R"({{"event":"{}",{}}})", event, fields) << std::endl;
}

void ProgressPrinter::count(const std::string& what, std::size_t done, std::size_t all) {
  if (mode_ == Mode::quiet || done == counted_) return;
  const double now = seconds_();
  if (mode_ == Mode::bar) {
    out_ << "\r\033[K" << what << " " << done << "/" << all << std::flush;
    bar_shown_ = true;
  } else if (done == all || now - count_time_ >= (mode_ == Mode::json ? 1 : line_interval)) {
    if (mode_ == Mode::lines) out_ << what << " " << done << "/" << all << std::endl;
    tell("count", fmt::format(R"("what":{},"done":{},"of":{})", quoted(what), done, all));
    count_time_ = now;
  }
  counted_ = done;
}

void ProgressPrinter::say(const std::string& text) {
  if (mode_ == Mode::quiet) return;
  if (mode_ == Mode::json) return tell("say", "\"text\":" + quoted(printable(text, true)));
  clear();
  out_ << printable(text, true) << std::endl;
}

void ProgressPrinter::clear() {
  if (bar_shown_) out_ << "\r\033[K" << std::flush;
  bar_shown_ = false;
}

std::string ProgressPrinter::line(const Running& running) const {
  const Progress& progress = running.latest;
  std::string text = fmt::format("{} ({}/{}) {} {:.0f} %", running.id, running.number, total_, progress.stage,
                                 100 * progress.fraction);
  if (progress.step > 0) text += fmt::format(", step {}", progress.step);
  if (std::isfinite(progress.strain) && progress.strain != 0)
    text += fmt::format(", strain {:.3g} %", 100 * progress.strain);
  if (std::isfinite(progress.stress) && progress.stress != 0)
    text += fmt::format(", stress {:.4g} MPa", 1e-6 * progress.stress);
  const double left = seconds_left(running);
  if (std::isfinite(left)) text += ", " + duration_text(left) + " left";
  return text;
}

std::string ProgressPrinter::study_line() const {
  std::string text = fmt::format("{}/{} done", done_, total_);
  for (const Running& running : running_) {
    text += fmt::format(", {} {:.0f} %", running.id, 100 * running.latest.fraction);
    const double left = seconds_left(running);
    if (std::isfinite(left)) text += " (" + duration_text(left) + " left)";
  }
  return text;
}

double ProgressPrinter::seconds_left(const Running& running) const {
  const double done = running.latest.fraction - running.first_fraction;
  const double taken = seconds_() - running.first_time;
  if (running.first_fraction < 0 || done < 0.01 || taken < 1) return std::numeric_limits<double>::quiet_NaN();
  return taken * std::max(1 - running.latest.fraction, 0.0) / done;
}

}  // namespace dem
