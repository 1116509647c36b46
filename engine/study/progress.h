#pragma once
// What a person sees of a running study: a bar on a terminal, now and then a plain line in a log, or nothing.
#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

#include "engine/model/model.h"

namespace dem {

class ProgressPrinter {
 public:
  enum class Mode { bar, lines, quiet, json };  ///< json: an object a line

  /// `seconds` is a clock (for tests), `width` the columns of the terminal.
  ProgressPrinter(std::ostream& out, Mode mode, std::function<double()> seconds, int width = 100);
  ~ProgressPrinter() { clear(); }
  ProgressPrinter(const ProgressPrinter&) = delete;
  ProgressPrinter& operator=(const ProgressPrinter&) = delete;

  void start(int total);                                         ///< a study of so many cases starts
  void begin(const std::string& id, int number);                 ///< a case starts; others may be running
  void update(const std::string& id, const Progress& progress);  ///< of a case that has begun; at any rate
  void end(const std::string& id);                               ///< a case is done, whether it has begun or not
  void count(const std::string& what, std::size_t done, std::size_t all);  ///< "drawing 12/40"; at any rate
  void say(const std::string& line);                                       ///< a whole line, the bar out of its way

  void clear();  ///< takes the bar away, for what others print

 private:
  struct Running {
    std::string id;
    int number = 0;
    double first_time = 0;       ///< of its first report
    double first_fraction = -1;  ///< what was done by then (a resumed case does not start at 0); -1: no report yet
    double shown_time = 0;       ///< of its last line in the log
    double shown_fraction = 0;
    Progress latest{};
  };

  /// "compression_ar_2 (3/6) loading 42 %, step 16800, strain 0.213 %, stress 151.2 MPa, 1 min 23 s left"
  [[nodiscard]] std::string line(const Running& running) const;
  /// "2/6 done, compression_ar_2 42 % (1 min 23 s left), compression_ar_3 17 %"
  [[nodiscard]] std::string study_line() const;
  [[nodiscard]] double seconds_left(const Running& running) const;  ///< NaN: no idea yet
  void tell(const std::string& event, const std::string& fields);   ///< an object, in json
  void draw_bar();
  void write_line(Running& running);

  std::ostream& out_;
  Mode mode_;
  std::function<double()> seconds_;
  int width_;
  int total_ = 0;
  int done_ = 0;
  std::vector<Running> running_;  // in the order of their beginning
  double bar_time_ = 0;
  double count_time_ = 0;
  std::size_t counted_ = 0;
  bool bar_shown_ = false;
};

/// "45 s", "1 min 23 s", "2 h 05 min"
std::string duration_text(double seconds);

}  // namespace dem
