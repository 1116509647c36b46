#include "engine/calibration/least_squares.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dem::calibration {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

Eigen::VectorXd weighed_residual(const Problem& problem, const std::vector<double>& answer) {
  Eigen::VectorXd r(static_cast<Eigen::Index>(problem.targets.size()));
  for (std::size_t i = 0; i < problem.targets.size(); ++i) {
    const Target& target = problem.targets[i];
    r[static_cast<Eigen::Index>(i)] = (target.value - answer[i]) / target.deviation;
  }
  return r;
}

Eigen::MatrixXd weighed(const Problem& problem, const Eigen::MatrixXd& jacobian) {
  Eigen::MatrixXd w = jacobian;
  for (std::size_t i = 0; i < problem.targets.size(); ++i)
    w.row(static_cast<Eigen::Index>(i)) /= problem.targets[i].deviation;
  return w;
}

bool all_close(const Problem& problem, const std::vector<double>& answer) {
  for (std::size_t i = 0; i < problem.targets.size(); ++i) {
    if (std::abs(problem.targets[i].value - answer[i]) > problem.targets[i].close) return false;
  }
  return true;
}

bool is_finite(const Answer& answer) {
  return answer && std::ranges::all_of(*answer, [](double value) { return std::isfinite(value); });
}

/// The search while it goes.
class Search {
 public:
  Search(const Problem& problem, const Evaluate& evaluate, const SearchOptions& options)
      : problem_(problem), evaluate_(evaluate), options_(options), farthest_(options.farthest) {
    found_.jacobian = problem.jacobian;
    found_.misfit = infinite;
    found_.at_low.assign(problem.unknowns.size(), false);
    found_.at_high.assign(problem.unknowns.size(), false);
  }

  Solution run() {
    std::vector<double> start;
    for (const Unknown& unknown : problem_.unknowns)
      start.push_back(std::clamp(unknown.start, unknown.low, unknown.high));
    found_.point = start;
    if (!take(start)) return end(Ending::failed);
    int failures = 0, misses = 0;
    while (true) {
      if (all_close(problem_, *found_.answer)) return end(Ending::met);
      if (left() < 1) return end(Ending::exhausted);
      const std::vector<double> next = step(problem_, found_.point, *found_.answer, found_.jacobian, damping_,
                                            farthest_, &found_.at_low, &found_.at_high);
      if (gain(next) < 0.01 * found_.misfit) {
        if (measure()) continue;
        return end(Ending::settled);
      }
      const double before = found_.misfit;
      if (!evaluate_one(next)) {
        if (++failures == 4) return end(found_.path.size() > 5 ? Ending::settled : Ending::failed);
        farthest_ *= 0.5;
        damping_ = std::max(10 * damping_, 1e-3);
        continue;
      }
      if (found_.misfit < before) {
        damping_ *= 0.2;
        misses = found_.misfit > 0.9 * before ? misses + 1 : 0;
      } else {
        damping_ = std::max(5 * damping_, 1e-2);
        ++misses;
      }
      if (misses < 2) continue;
      misses = 0;
      if (!measure() && ++stuck_ == 2) return end(Ending::settled);
    }
  }

 private:
  [[nodiscard]] int left() const { return options_.evaluations - static_cast<int>(found_.path.size()); }

  Solution end(Ending ending) {
    found_.ending = ending;
    return std::move(found_);
  }

  /// What the step should take off the misfit, by what is known.
  [[nodiscard]] double gain(const std::vector<double>& next) const {
    const Eigen::VectorXd r = weighed_residual(problem_, *found_.answer);
    Eigen::VectorXd d(static_cast<Eigen::Index>(next.size()));
    for (std::size_t k = 0; k < next.size(); ++k) d[static_cast<Eigen::Index>(k)] = next[k] - found_.point[k];
    return r.squaredNorm() - (r - weighed(problem_, found_.jacobian) * d).squaredNorm();
  }

  /// Takes the point as the best when it is; false when it failed.
  bool take(const std::vector<double>& point) {
    const std::vector<Answer> answers = evaluate_({point});
    return record(point, answers.front(), false);
  }

  bool record(const std::vector<double>& point, const Answer& answer, bool difference) {
    Trial trial{point, answer, infinite, false, difference};
    const bool good = is_finite(answer);
    if (good) trial.misfit = misfit(problem_, *answer);
    trial.is_best = good && trial.misfit < found_.misfit;
    found_.path.push_back(trial);
    if (trial.is_best) {
      found_.point = point;
      found_.answer = answer;
      found_.misfit = trial.misfit;
    }
    return good;
  }

  bool evaluate_one(const std::vector<double>& next) {
    const std::vector<double> from = found_.point, from_answer = *found_.answer;
    if (!take(next)) return false;
    learn(problem_, from, from_answer, next, *found_.path.back().answer, found_.jacobian);
    return true;
  }

  /// Every column by a difference, all side by side; false when there are no evaluations left for it, or it was done before.
  bool measure() {
    const auto n = problem_.unknowns.size();
    if (!options_.may_measure || measured_ || left() < static_cast<int>(n) + 1) return false;
    measured_ = true;
    const std::vector<double> from = found_.point, from_answer = *found_.answer;
    std::vector<std::vector<double>> points;
    for (std::size_t k = 0; k < n; ++k) {
      std::vector<double> point = from;
      const bool up = point[k] + options_.difference <= problem_.unknowns[k].high;
      point[k] = std::max(point[k] + (up ? 1 : -1) * options_.difference, problem_.unknowns[k].low);
      points.push_back(std::move(point));
    }
    const std::vector<Answer> answers = evaluate_(points);
    for (std::size_t k = 0; k < n; ++k) {
      const double h = points[k][k] - from[k];
      if (record(points[k], answers[k], true) && h != 0) {
        for (std::size_t i = 0; i < problem_.targets.size(); ++i) {
          found_.jacobian(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
              ((*answers[k])[i] - from_answer[i]) / h;
        }
      }
    }
    damping_ = 1e-3;
    farthest_ = options_.farthest;
    return true;
  }

  const Problem& problem_;
  const Evaluate& evaluate_;
  const SearchOptions& options_;
  Solution found_;
  double damping_ = 1e-3, farthest_;
  bool measured_ = false;
  int stuck_ = 0;
};

}  // namespace

std::string_view ending_word(Ending ending) {
  switch (ending) {
    case Ending::met:
      return "met";
    case Ending::settled:
      return "settled";
    case Ending::exhausted:
      return "exhausted";
    case Ending::failed:
      break;
  }
  return "failed";
}

double misfit(const Problem& problem, const std::vector<double>& answer) {
  return weighed_residual(problem, answer).squaredNorm();
}

std::vector<double> step(const Problem& problem, const std::vector<double>& point, const std::vector<double>& answer,
                         const Eigen::MatrixXd& jacobian, double damping, double farthest, std::vector<bool>* at_low,
                         std::vector<bool>* at_high) {
  const std::size_t n = problem.unknowns.size();
  const Eigen::VectorXd r = weighed_residual(problem, answer);
  const Eigen::MatrixXd whole = weighed(problem, jacobian);
  std::vector<bool> held(n, false), low(n, false), high(n, false);
  std::vector<double> next = point;
  // An unknown that would cross its bound, or go too far, is put there, and the others are found anew without it.
  for (std::size_t round = 0; round <= n; ++round) {
    std::vector<Eigen::Index> open;
    Eigen::VectorXd rest = r;
    for (std::size_t k = 0; k < n; ++k) {
      if (held[k]) {
        rest -= whole.col(static_cast<Eigen::Index>(k)) * (next[k] - point[k]);
      } else {
        open.push_back(static_cast<Eigen::Index>(k));
      }
    }
    if (open.empty()) break;
    const Eigen::MatrixXd part = whole(Eigen::all, open);
    Eigen::MatrixXd normal = part.transpose() * part;
    const Eigen::VectorXd diagonal = normal.diagonal();
    const double least = 1e-9 * std::max(diagonal.maxCoeff(), 1e-300);
    for (Eigen::Index k = 0; k < normal.rows(); ++k) normal(k, k) += damping * diagonal[k] + least;
    const Eigen::VectorXd delta = normal.ldlt().solve(part.transpose() * rest);
    // The worst first: without it others may stay inside.
    std::optional<std::size_t> worst;
    double most = 0;
    for (std::size_t j = 0; j < open.size(); ++j) {
      const auto k = static_cast<std::size_t>(open[j]);
      const double wanted = point[k] + delta[static_cast<Eigen::Index>(j)];
      const Unknown& unknown = problem.unknowns[k];
      const double reached = std::clamp(wanted, point[k] - farthest, point[k] + farthest);
      next[k] = std::clamp(reached, unknown.low, unknown.high);
      low[k] = reached < unknown.low;
      high[k] = reached > unknown.high;
      if (std::abs(next[k] - wanted) <= most) continue;
      most = std::abs(next[k] - wanted);
      worst = k;
    }
    if (!worst) break;
    held[*worst] = true;
  }
  if (at_low) *at_low = low;
  if (at_high) *at_high = high;
  return next;
}

void learn(const Problem& problem, const std::vector<double>& from, const std::vector<double>& from_answer,
           const std::vector<double>& to, const std::vector<double>& to_answer, Eigen::MatrixXd& jacobian) {
  Eigen::VectorXd d(static_cast<Eigen::Index>(to.size()));
  for (std::size_t k = 0; k < to.size(); ++k) d[static_cast<Eigen::Index>(k)] = to[k] - from[k];
  const double length = d.squaredNorm();
  if (length == 0) return;
  for (std::size_t i = 0; i < problem.targets.size(); ++i) {
    const Target& target = problem.targets[i];
    const auto row = static_cast<Eigen::Index>(i);
    const double error = problem.jacobian_error * target.scale, prior = error * error;
    const double surprise = to_answer[i] - from_answer[i] - jacobian.row(row).dot(d);
    const double gain = prior / (prior * length + 2 * target.noise * target.noise);
    jacobian.row(row) += gain * surprise * d.transpose();
  }
}

Solution search(const Problem& problem, const Evaluate& evaluate, const SearchOptions& options) {
  return Search(problem, evaluate, options).run();
}

}  // namespace dem::calibration
