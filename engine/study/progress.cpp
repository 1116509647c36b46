#include "engine/study/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>

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

}  // namespace

std::string duration_text(double seconds) {
  const auto whole = static_cast<long>(std::lround(std::max(seconds, 0.0)));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

ProgressPrinter::ProgressPrinter(std::ostream& out, Mode mode, std::function<double()> seconds, int width)
    : out_(out), mode_(mode), seconds_(std::move(seconds)), width_(width) {}

void ProgressPrinter::begin(const std::string& id, int number, int total) {
  label_ = fmt::format("{} ({}/{})", id, number, total);
  first_fraction_ = -1;
  shown_time_ = seconds_();
  shown_fraction_ = 0;
}

void ProgressPrinter::update(const Progress& progress) {
  if (mode_ == Mode::quiet) return;
  const double now = seconds_();
  if (first_fraction_ < 0) {
    first_fraction_ = progress.fraction;
    first_time_ = now;
    shown_fraction_ = progress.fraction;
  }
  const double silent = now - shown_time_;
  if (mode_ == Mode::bar) {
    if (silent < bar_interval && bar_shown_) return;
    std::string text = bar(progress.fraction) + line(progress);
    if (static_cast<int>(text.size()) > width_ - 1) text.resize(static_cast<std::size_t>(std::max(width_ - 1, 0)));
    out_ << "\r\033[K" << text << std::flush;
    bar_shown_ = true;
  } else {
    const bool moved = progress.fraction - shown_fraction_ >= line_share || silent >= line_silence;
    if (silent < line_interval || !moved) return;
    out_ << line(progress) << std::endl;
    shown_fraction_ = progress.fraction;
  }
  shown_time_ = now;
}

void ProgressPrinter::say(const std::string& text) {
  if (mode_ == Mode::quiet) return;
  clear();
  out_ << text << std::endl;
}

void ProgressPrinter::clear() {
  if (bar_shown_) out_ << "\r\033[K" << std::flush;
  bar_shown_ = false;
}

std::string ProgressPrinter::line(const Progress& progress) const {
  std::string text = fmt::format("{} {} {:.0f} %", label_, progress.stage, 100 * progress.fraction);
  if (progress.step > 0) text += fmt::format(", step {}", progress.step);
  if (std::isfinite(progress.strain) && progress.strain != 0)
    text += fmt::format(", strain {:.3g} %", 100 * progress.strain);
  if (std::isfinite(progress.stress) && progress.stress != 0)
    text += fmt::format(", stress {:.4g} MPa", 1e-6 * progress.stress);
  const double left = seconds_left(progress);
  if (std::isfinite(left)) text += ", " + duration_text(left) + " left";
  return text;
}

double ProgressPrinter::seconds_left(const Progress& progress) const {
  const double done = progress.fraction - first_fraction_;
  const double taken = seconds_() - first_time_;
  if (first_fraction_ < 0 || done < 0.01 || taken < 1) return std::numeric_limits<double>::quiet_NaN();
  return taken * std::max(1 - progress.fraction, 0.0) / done;
}

}  // namespace dem
