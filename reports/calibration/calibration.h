#pragma once
// The calibration of a rock: subject by subject, stage by stage, then confirmed over fresh seeds.
#include <functional>
#include <string>
#include <vector>

#include "engine/analysis/fits.h"
#include "engine/calibration/least_squares.h"
#include "reports/calibration/plan.h"
#include "reports/calibration/trials.h"

namespace calibrate {

/// A place of the search: factors on the parameters that move, and what came out beside the targets.
struct Step {
  std::string stage;            ///< of the search; "fresh seeds"; "mean", at the end, of all specimens
  std::vector<double> factors;  ///< of Subject::moved; those not free in the stage as they were
  std::vector<double> values;   ///< of every target, in its unit; NaN: not measured there, or the test failed
  bool is_best = false, is_difference = false, failed = false;
  std::string error = {};                       ///< why it failed
  int seeds = 1;                                ///< that the values are means of
  int most_seeds = 0;                           ///< where some are means of more
  [[nodiscard]] std::string specimens() const;  ///< "13", "13 to 29"
};

struct ParameterResult {
  std::size_t candidate = 0;
  double factor = 1;
  double low = 1, high = 1;    ///< 95 % interval of the factor
  std::vector<double> values;  ///< of its keys, SI
  bool at_low = false, at_high = false;
  bool is_determined = true;  ///< the tests that were run react to it enough for an interval
};

struct TargetResult {
  dem::analysis::Estimate ours;  ///< mean over specimens
  double deviation = 0;          ///< between specimens, in its unit
  int specimens = 0;             ///< that the mean is of
  reports::Verdict verdict = reports::Verdict::not_computed;
};

/// What could be measured to determine a parameter that was kept.
struct Advice {
  std::size_t candidate = 0;
  std::string measure;   ///< "a peak at 20 MPa"; "": nothing that is known here would
  double deviation = 0;  ///< of the parameter then, in logarithms
};

struct SubjectResult {
  Subject subject;
  std::vector<Step> path;
  std::vector<std::string> stage_ends;  ///< "elastic: met after 3 trials"
  std::vector<ParameterResult> parameters;
  std::vector<TargetResult> targets;
  Eigen::MatrixXd correlation;  ///< of the parameters that moved
  double condition = 0;         ///< of the derivatives at the end
  std::vector<Advice> advice;
  int tests = 0;
  std::string specimens;  ///< that the means are of: "13 to 29"
  double steps = 0;
  std::vector<std::string> problems;  ///< what a person should do, a sentence each; empty: all is met
  bool is_met = false;
};

struct Outcome {
  std::vector<SubjectResult> subjects;
  Values values;  ///< of all keys that moved, SI
  [[nodiscard]] bool is_met() const;
  int simulated = 0;   ///< tests that this run of the program has made; others were kept
  double seconds = 0;  ///< that they took, one after the other
};

/// Who is told on the way.
struct Listener {
  dem::StudyListener tests;
  std::function<void(int)> starting = [](int) {};                           ///< how many tests run next, side by side
  std::function<void(const std::string&)> say = [](const std::string&) {};  ///< a line for each trial
};

/// Throws as dem::run_study().
Outcome calibrate(const dem::Study& study, const Plan& plan, const dem::StudyOptions& options,
                  const Listener& listener);

}  // namespace calibrate
