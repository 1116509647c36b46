#pragma once
// Nonlinear least squares where an evaluation is dear and not smooth: Levenberg and Marquardt's steps between bounds, with a
// matrix of derivatives that is known roughly beforehand, learns from every evaluation (Broyden 1965, damped by the noise of
// the answers), and is measured by differences only when the search is stuck. No simulation here: what is evaluated is a
// function.
//
// Points and answers are whatever the caller searches in: logarithms, for parameters and results that are positive.
#include <Eigen/Dense>

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

namespace dem::calibration {

/// Answers at a point, one a target; none: the evaluation failed.
using Answer = std::optional<std::vector<double>>;
/// Answers at several points, which may be found side by side.
using Evaluate = std::function<std::vector<Answer>(const std::vector<std::vector<double>>& points)>;

struct Unknown {
  double start = 0;
  double low = 0, high = 0;  ///< inclusive
};

struct Target {
  double value = 0;
  double deviation = 1;  ///< standard deviation by which a misfit is weighed
  double close = 0.1;    ///< a misfit is small enough at this
  double noise = 0;      ///< of an answer, beside a smooth function: what a change has to exceed to teach much
  double scale = 1;      ///< of the answer: an error of `jacobian_error` is this much of it for a unit of an unknown
};

struct Problem {
  std::vector<Unknown> unknowns;
  std::vector<Target> targets;
  Eigen::MatrixXd jacobian;     ///< targets x unknowns: what is known beforehand
  double jacobian_error = 0.3;  ///< of its entries, in `scale` of their target
};

struct SearchOptions {
  int evaluations = 20;      ///< at most, the differences included
  double farthest = 0.7;     ///< longest step of an unknown
  double difference = 0.15;  ///< step of the differences
  bool may_measure = true;   ///< the derivatives by differences, when the search is stuck
};

enum class Ending {
  met,        ///< every misfit is close
  settled,    ///< no step makes it better: the best there is
  exhausted,  ///< the evaluations are used up
  failed      ///< the start, or every step from it, failed to evaluate
};
std::string_view ending_word(Ending ending);

/// One evaluation of the search.
struct Trial {
  std::vector<double> point;
  Answer answer;
  double misfit = 0;           ///< sum of squares of weighed misfits; infinite where it failed
  bool is_best = false;        ///< of those so far
  bool is_difference = false;  ///< made for the derivatives
};

struct Solution {
  Ending ending = Ending::failed;
  std::vector<double> point;
  Answer answer;
  double misfit = 0;
  Eigen::MatrixXd jacobian;  ///< as learnt by the end
  std::vector<Trial> path;
  std::vector<bool> at_low, at_high;  ///< which unknowns ended at a bound that the step would have crossed
};

Solution search(const Problem& problem, const Evaluate& evaluate, const SearchOptions& options = {});

/// One undamped step from a point with these answers, between bounds and not longer than `farthest`.
std::vector<double> step(const Problem& problem, const std::vector<double>& point, const std::vector<double>& answer,
                         const Eigen::MatrixXd& jacobian, double damping, double farthest,
                         std::vector<bool>* at_low = nullptr, std::vector<bool>* at_high = nullptr);

/// Learns from two answers: the Jacobian changed least, weighed by its error and the noise, so that it explains them.
void learn(const Problem& problem, const std::vector<double>& from, const std::vector<double>& from_answer,
           const std::vector<double>& to, const std::vector<double>& to_answer, Eigen::MatrixXd& jacobian);

double misfit(const Problem& problem, const std::vector<double>& answer);

}  // namespace dem::calibration
