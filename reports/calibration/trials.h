#pragma once
// Trials as cases: a test of one specimen with some values of parameters. Each is kept by its content in the folder of the
// study, so that a search that is cut off goes on with the same command and runs nothing twice.
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/study/study.h"
#include "reports/calibration/plan.h"

namespace calibrate {

/// Values of scenario keys, SI.
using Values = std::map<std::string, double>;

struct Wish {
  Test test;
  std::string mineral;  ///< "": the rock
  std::uint64_t seed = 1;
  Values values;
};

/// What a test gave; none of a quantity that it did not give.
struct Reading {
  std::optional<std::map<std::string, double, std::less<>>> results;  ///< by id; none: the test failed
  std::string error;                                                  ///< why
  std::vector<std::string> broken;                                    ///< checks that did not hold
  [[nodiscard]] double value(std::string_view result) const;          ///< NaN
};

class Trials {
 public:
  /// `starting` is told how many tests run next.
  Trials(const dem::Study& study, const dem::StudyOptions& options, dem::StudyListener listener,
         std::function<void(int)> starting);

  /// Runs those that are not kept, side by side. Throws as dem::run_study().
  std::vector<Reading> run(const std::vector<Wish>& wishes);

  [[nodiscard]] int tests() const { return tests_; }          ///< different ones that were asked for
  [[nodiscard]] double steps() const { return steps_; }       ///< of all of them
  [[nodiscard]] int simulated() const { return simulated_; }  ///< in this run of the program
  [[nodiscard]] double seconds() const { return seconds_; }   ///< that those took

 private:
  [[nodiscard]] dem::CaseSpec case_of(const Wish& wish) const;

  const dem::Study& study_;
  const dem::StudyOptions& options_;
  dem::StudyListener listener_;
  std::function<void(int)> starting_;
  std::map<std::string, Reading> known_;  ///< by content
  int tests_ = 0, simulated_ = 0;
  double steps_ = 0, seconds_ = 0;
};

}  // namespace calibrate
