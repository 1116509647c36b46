#pragma once
// What a person sees of a running study: a bar on a terminal, now and then a plain line in a log, or nothing.
#include <functional>
#include <iosfwd>
#include <string>

#include "engine/study/model.h"

namespace dem {

class ProgressPrinter {
 public:
  enum class Mode { bar, lines, quiet };

  /// `seconds` is a clock (for tests), `width` the columns of the terminal.
  ProgressPrinter(std::ostream& out, Mode mode, std::function<double()> seconds, int width = 100);
  ~ProgressPrinter() { clear(); }
  ProgressPrinter(const ProgressPrinter&) = delete;
  ProgressPrinter& operator=(const ProgressPrinter&) = delete;

  void begin(const std::string& id, int number, int total);  ///< a case starts
  void update(const Progress& progress);                     ///< may be called at any rate
  void say(const std::string& line);                         ///< a whole line, the bar out of its way

  void clear();  ///< takes the bar away, for what others print

  /// "compression_ar_2 (3/6) loading 42 %, step 16800, strain 0.213 %, stress 151.2 MPa, 1 min 23 s left"
  [[nodiscard]] std::string line(const Progress& progress) const;

 private:
  [[nodiscard]] double seconds_left(const Progress& progress) const;  ///< NaN: no idea yet

  std::ostream& out_;
  Mode mode_;
  std::function<double()> seconds_;
  int width_;
  std::string label_;
  double first_time_ = 0;       ///< of the first report of this case
  double first_fraction_ = -1;  ///< what was done by then (a resumed case does not start at 0); -1: no report yet
  double shown_time_ = 0;
  double shown_fraction_ = 0;
  bool bar_shown_ = false;
};

/// "45 s", "1 min 23 s", "2 h 05 min"
std::string duration_text(double seconds);

}  // namespace dem
