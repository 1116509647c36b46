#include "reports/calibration/calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "engine/calibration/mean_response.h"
#include "engine/scenario/scenario.h"
#include "reports/calibration/rock_file.h"
#include "reports/calibration/sensitivities.h"
#include "reports/text.h"

namespace calibrate {
namespace {

namespace search = dem::calibration;
using dem::analysis::Estimate;
using reports::Verdict;

// A misfit of means is small enough at this share of its standard deviation: less would follow the noise of the seeds. One seed
// stands apart from the mean by its whole deviation, which fresh seeds take out afterwards.
constexpr double close_share = 0.4, close_share_of_one_seed = 1.0;
// What a step changes of a result beside the smooth part, over the scatter between seeds: the cracks run otherwise.
constexpr double noise_share = 0.3;
// The scatter is pooled with what is known of it, which counts as so many degrees of freedom.
constexpr int known_freedom = 4;
// A mean is told at this share of what the laboratory leaves open.
constexpr double told_share = 0.5;
// Fresh seeds at each step towards the means: few at many places tell more than many at few, as each step is better than the
// one before.
constexpr int seeds_of_a_step = 2;
// Rounds of all fresh seeds at the end, at most.
constexpr int most_rounds = 3;
// Longest step towards the means, in logarithms.
constexpr double farthest = 0.3;

double scale_of(const Target& target) { return target.is_logarithmic() ? 1 : 0.15; }

/// Of values that a person would call met where the laboratory states no uncertainty.
std::pair<double, double> band_of(const Target& target) {
  const reports::LaboratoryNumber& number = target.number;
  if (number.deviation > 0) return {number.low, number.high};
  const double reach = target.is_logarithmic() ? 0.02 * number.value : 0.01;
  return {number.value - reach, number.value + reach};
}

/// How closely the laboratory knows the value, in the coordinate of the search.
double laboratory_width(const Target& target) {
  if (target.number.deviation > 0) return target.laboratory_deviation();
  const auto [low, high] = band_of(target);
  return 0.5 * (target.is_logarithmic() ? std::log(high / low) : high - low);
}

std::string deviation_words(const Target& target, double value) {
  if (!std::isfinite(value)) return target.symbol() + " not measured";
  if (!target.is_logarithmic()) return fmt::format("{} {:+.3f}", target.symbol(), value - target.number.value);
  return fmt::format("{} {:+.1f} %", target.symbol(), 100 * (value / target.number.value - 1));
}

/// One subject while it is calibrated.
class Work {
 public:
  Work(const dem::Study& study, const Plan& plan, const Subject& subject, Values given, Trials& trials,
       const std::function<void(const std::string&)>& say)
      : study_(study),
        plan_(plan),
        given_(std::move(given)),
        trials_(trials),
        say_(say),
        tests_before_(trials.tests()),
        steps_before_(trials.steps()) {
    result_.subject = subject;
    for (const std::size_t k : subject.moved) moved_.push_back(subject.candidates[k]);
    x_.assign(moved_.size(), 0);
    lost_.assign(moved_.size(), false);
    jacobian_ = known_derivatives(subject, moved_);
  }

  SubjectResult run() {
    bool well = true;
    for (const Stage& stage : result_.subject.stages) well = well && search_stage(stage);
    if (well) confirm();
    finish();
    return std::move(result_);
  }

  [[nodiscard]] Values values() const { return values_at(x_); }

 private:
  [[nodiscard]] int used() const { return trials_.tests() - tests_before_; }
  [[nodiscard]] int left() const { return result_.subject.budget - used(); }

  [[nodiscard]] Values values_at(const std::vector<double>& x) const {
    Values values = given_;
    for (std::size_t k = 0; k < moved_.size(); ++k) {
      for (std::size_t i = 0; i < moved_[k].keys.size(); ++i)
        values[moved_[k].keys[i]] = rounded(moved_[k].start[i] * std::exp(x[k]), moved_[k].unit);
    }
    return values;
  }

  [[nodiscard]] std::vector<double> factors(const std::vector<double>& x) const {
    std::vector<double> all;
    for (const double one : x) all.push_back(std::exp(one));
    return all;
  }

  [[nodiscard]] Wish wish(const Test& test, std::uint64_t seed, const Values& values) const {
    return {test, result_.subject.mineral, seed, values};
  }

  /// A target's value from the tests that were run, in its unit.
  [[nodiscard]] double value_of(const Target& target, const std::vector<Test>& tests,
                                const std::vector<Reading>& readings) const {
    const auto of = [&](double pressure, std::string_view result) {
      for (std::size_t i = 0; i < tests.size(); ++i) {
        if (tests[i].name == target.number.test && tests[i].pressure == pressure) return readings[i].value(result);
      }
      return std::nan("");
    };
    if (target.number.fit.empty()) return of(target.number.pressure, target.number.result);
    std::vector<double> sigma_3, sigma_1;
    for (const double pressure : result_.subject.pressures) {
      const double peak = of(pressure, "compressive_strength");
      if (!std::isfinite(peak)) return std::nan("");
      sigma_3.push_back(pressure);
      sigma_1.push_back(peak);
    }
    const auto fit = dem::analysis::fit_peak_m(sigma_3, sigma_1, sigma_1.front());
    return fit ? fit->m.value : std::nan("");
  }

  [[nodiscard]] static std::string first_error(const std::vector<Reading>& readings) {
    for (const Reading& reading : readings) {
      if (!reading.error.empty()) return reading.error;
    }
    return {};
  }

  [[nodiscard]] static search::Target goal(const Target& target, double deviation, double close, double noise) {
    return {target.to_search(target.number.value), deviation, close * deviation, noise, scale_of(target)};
  }

  void tell(const std::string& stage, int number, const std::string& words) const {
    say_(fmt::format("{}, {}, trial {}: {}", result_.subject.title(), stage, number, words));
  }

  /// False when nothing could be evaluated.
  bool search_stage(const Stage& stage) {
    search::Problem problem;
    for (const std::size_t k : stage.parameters)
      problem.unknowns.push_back({x_[k], std::log(moved_[k].low), std::log(moved_[k].high)});
    const bool elastic = stage.tests.front().is_elastic;
    for (const std::size_t i : stage.targets) {
      const Target& target = result_.subject.targets[i];
      const double noise = (elastic ? 0.1 : noise_share) * scatter(target.number.key);
      problem.targets.push_back(goal(target, expected_deviation(target, 1), close_share_of_one_seed, noise));
    }
    const std::vector<Eigen::Index> rows(stage.targets.begin(), stage.targets.end()),
        columns(stage.parameters.begin(), stage.parameters.end());
    problem.jacobian = jacobian_(rows, columns);

    const auto at_stage = [&](const std::vector<double>& point) {
      std::vector<double> x = x_;
      for (std::size_t j = 0; j < stage.parameters.size(); ++j) x[stage.parameters[j]] = point[j];
      return x;
    };
    int number = 0;
    std::string error;
    const auto evaluate = [&](const std::vector<std::vector<double>>& points) {
      std::vector<Wish> wishes;
      for (const auto& point : points) {
        for (const Test& test : stage.tests)
          wishes.push_back(wish(test, study_.scenario.seed(), values_at(at_stage(point))));
      }
      const std::vector<Reading> readings = trials_.run(wishes);
      std::vector<search::Answer> answers;
      for (std::size_t p = 0; p < points.size(); ++p) {
        const auto begin = readings.begin() + static_cast<std::ptrdiff_t>(p * stage.tests.size());
        const std::vector<Reading> own(begin, begin + static_cast<std::ptrdiff_t>(stage.tests.size()));
        std::vector<double> answer;
        std::vector<std::string> words;
        Step step{stage.id, factors(at_stage(points[p])),
                  std::vector<double>(result_.subject.targets.size(), std::nan(""))};
        for (const std::size_t i : stage.targets) {
          const Target& target = result_.subject.targets[i];
          step.values[i] = value_of(target, stage.tests, own);
          answer.push_back(target.to_search(step.values[i]));
          words.push_back(deviation_words(target, step.values[i]));
        }
        step.failed = std::ranges::any_of(answer, [](double v) { return !std::isfinite(v); });
        step.error = step.failed ? first_error(own) : "";
        if (step.failed && error.empty()) error = step.error;
        tell(stage.id, ++number, reports::joined(words, ", "));
        answers.push_back(step.failed ? search::Answer() : search::Answer(answer));
        result_.path.push_back(std::move(step));
      }
      return answers;
    };
    const std::size_t before = result_.path.size();
    const int each = static_cast<int>(stage.tests.size());
    // The seed of the search can be far from the mean of others. So half of the budget is for fresh ones, and one round of
    // them in any case.
    const int round = static_cast<int>(confirming_tests().size()) * plan_.seeds;
    const int reserve = std::max(result_.subject.budget / (2 * round), 1) * round;
    search::SearchOptions options;
    options.evaluations = std::max((left() - reserve) / each, 1);
    options.may_measure = options.evaluations > 2 * static_cast<int>(stage.parameters.size());
    const search::Solution found = search::search(problem, evaluate, options);
    for (std::size_t t = 0; t < found.path.size(); ++t) {
      result_.path[before + t].is_best = found.path[t].is_best;
      result_.path[before + t].is_difference = found.path[t].is_difference;
    }
    x_ = at_stage(found.point);
    jacobian_(rows, columns) = found.jacobian;
    // The seed of the search is one specimen more for the means, as far as whole tests were run.
    samples_.clear();
    if (!elastic && found.answer) {
      samples_.push_back({x_, std::vector<std::vector<double>>(result_.subject.targets.size())});
      for (std::size_t t = 0; t < stage.targets.size(); ++t)
        samples_.back().values[stage.targets[t]] = {(*found.answer)[t]};
    }
    // Only differences tell that a parameter moves nothing: what a search learns on its way holds the noise of the cracks.
    if (std::ranges::any_of(found.path, [](const auto& trial) { return trial.is_difference; }))
      keep_what_moves_nothing(stage, problem);
    for (std::size_t j = 0; j < stage.parameters.size(); ++j) {
      if (lost_[stage.parameters[j]]) continue;
      if (found.at_low[j] || found.at_high[j]) bounded_.push_back({stage.parameters[j], found.at_high[j]});
    }
    exhausted_ = exhausted_ || found.ending == search::Ending::exhausted;
    result_.stage_ends.push_back(fmt::format("{} ({}): {} after {} trial{}", stage.id,
                                             symbols(result_.subject, stage.targets), search::ending_word(found.ending),
                                             found.path.size(), found.path.size() == 1 ? "" : "s"));
    if (found.ending != search::Ending::failed) return true;
    result_.problems.push_back(fmt::format(
        "The tests of the stage “{}” gave no result to go on from{}. Start from other values of the parameters, or "
        "look at the test alone: run the scenario with them.",
        stage.id, error.empty() ? std::string() : ": " + error));
    return false;
  }

  /// The sensitivities that a search begins with may not be those of this specimen. A parameter to which its tests turned
  /// out not to react goes back to its start: where the search has left it means nothing.
  void keep_what_moves_nothing(const Stage& stage, const search::Problem& problem) {
    Eigen::MatrixXd weighed(static_cast<Eigen::Index>(stage.targets.size()),
                            static_cast<Eigen::Index>(stage.parameters.size()));
    for (Eigen::Index i = 0; i < weighed.rows(); ++i) {
      const auto row = static_cast<Eigen::Index>(stage.targets[static_cast<std::size_t>(i)]);
      for (Eigen::Index k = 0; k < weighed.cols(); ++k) {
        const auto column = static_cast<Eigen::Index>(stage.parameters[static_cast<std::size_t>(k)]);
        weighed(i, k) = jacobian_(row, column) / problem.targets[static_cast<std::size_t>(i)].deviation;
      }
    }
    const search::Identified known = search::identify(weighed, undetermined);
    for (std::size_t j = 0; j < stage.parameters.size(); ++j) {
      const std::size_t k = stage.parameters[j];
      if (known.free[j] || !is_moved_here(stage, k)) continue;
      lost_[k] = true;
      x_[k] = 0;
      jacobian_.col(static_cast<Eigen::Index>(k)).setZero();
    }
  }

  /// Whether no later stage moves it with more targets.
  [[nodiscard]] bool is_moved_here(const Stage& stage, std::size_t parameter) const {
    bool later = false;
    for (const Stage& other : result_.subject.stages) {
      if (&other != &stage && later && std::ranges::find(other.parameters, parameter) != other.parameters.end())
        return false;
      later = later || &other == &stage;
    }
    return true;
  }

  [[nodiscard]] std::vector<Test> confirming_tests() const {
    std::vector<Test> tests;
    const auto add = [&](const Test& test) {
      if (std::ranges::find(tests, test) == tests.end()) tests.push_back(test);
    };
    for (const Target& target : result_.subject.targets) {
      if (target.number.fit.empty()) {
        add({target.number.test, target.number.pressure});
      } else {
        for (const double p : result_.subject.pressures) add({target.number.test, p});
      }
    }
    return tests;
  }

  /// The tests that a further specimen should take. Those under pressure are most of the cost: they are left out once `seeds`
  /// specimens have taken them and what they tell is known as well as the laboratory knows it.
  [[nodiscard]] std::vector<Test> telling_tests(const search::Expected& now) const {
    std::vector<Test> tests = confirming_tests();
    const auto is_open = [&](std::size_t i) {
      const Target& target = result_.subject.targets[i];
      return target.is_confined() &&
             (now.specimens[i] < plan_.seeds || now.deviation[i] > told_share * laboratory_width(target));
    };
    for (std::size_t i = 0; i < now.deviation.size(); ++i) {
      if (is_open(i)) return tests;
    }
    if (!now.deviation.empty()) std::erase_if(tests, [](const Test& test) { return test.pressure > 0; });
    return tests;
  }

  /// Tests specimens that nothing has seen, with the parameters as they are now.
  void test_fresh(int round, int seeds, const std::vector<Test>& tests) {
    std::vector<Wish> wishes;
    for (int s = 0; s < seeds; ++s) {
      const std::uint64_t seed = study_.scenario.seed() + static_cast<std::uint64_t>(++fresh_seeds_);
      for (const Test& test : tests) wishes.push_back(wish(test, seed, values_at(x_)));
    }
    const std::vector<Reading> readings = trials_.run(wishes);
    fresh_tests_ += static_cast<int>(wishes.size());
    if (error_.empty()) error_ = first_error(readings);
    for (const Reading& reading : readings) {
      for (const std::string& check : reading.broken) ++broken_[check];
    }
    const auto under_pressure = std::ranges::count_if(tests, [](const Test& test) { return test.pressure > 0; });
    search::Sample sample{x_, {}};
    Step step{"fresh seeds", factors(x_), {}};
    step.seeds = seeds;
    std::vector<std::string> words;
    for (const Target& target : result_.subject.targets) {
      std::vector<double> values;
      for (int s = 0; s < seeds; ++s) {
        const auto begin = readings.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(s) * tests.size());
        const double value =
            target.to_search(value_of(target, tests, {begin, begin + static_cast<std::ptrdiff_t>(tests.size())}));
        if (std::isfinite(value)) values.push_back(value);
      }
      step.values.push_back(target.from_search(dem::analysis::mean_of(values).value));
      if (const bool left_out = target.is_confined() && under_pressure == 0; !left_out) {
        step.failed = step.failed || values.empty();
        words.push_back(deviation_words(target, step.values.back()));
      }
      sample.values.push_back(std::move(values));
    }
    step.error = step.failed ? first_error(readings) : "";
    tell("fresh seeds", round, fmt::format("{} (means of {})", reports::joined(words, ", "), seeds));
    result_.path.push_back(std::move(step));
    samples_.push_back(std::move(sample));
  }

  /// Means over all specimens that were tested, with the parameters as they are now.
  [[nodiscard]] search::Expected expected() const {
    search::Prior prior;
    prior.jacobian = jacobian_;
    prior.freedom = known_freedom;
    for (const Target& target : result_.subject.targets) {
      prior.scale.push_back(scale_of(target));
      prior.scatter.push_back(scatter(target.number.key));
    }
    return search::expected_at(x_, samples_, prior);
  }

  [[nodiscard]] search::Problem whole_problem(const search::Expected& now) const {
    search::Problem problem;
    for (std::size_t k = 0; k < moved_.size(); ++k) {
      if (lost_[k]) {
        problem.unknowns.push_back({x_[k], x_[k], x_[k]});
      } else {
        problem.unknowns.push_back({x_[k], std::log(moved_[k].low), std::log(moved_[k].high)});
      }
    }
    for (std::size_t i = 0; i < result_.subject.targets.size(); ++i) {
      const Target& target = result_.subject.targets[i];
      const double deviation = std::hypot(target.laboratory_deviation(), now.deviation[i]);
      problem.targets.push_back(goal(target, std::max(deviation, 1e-3), close_share, 0));
    }
    return problem;
  }

  /// Whether more seeds would change nothing: each mean is known as well as the laboratory knows its value, or is clearly off.
  [[nodiscard]] bool is_told(const search::Expected& now) const {
    for (std::size_t i = 0; i < now.mean.size(); ++i) {
      const Target& target = result_.subject.targets[i];
      const double off = std::abs(now.mean[i] - target.to_search(target.number.value)),
                   width = laboratory_width(target);
      if (now.deviation[i] > told_share * width && off < width + 3 * now.deviation[i]) return false;
    }
    return true;
  }

  /// A step to where the means should meet the targets, between the bounds.
  struct Correction {
    std::vector<double> next;
    std::vector<bool> low, high;
    Eigen::VectorXd results;  ///< what it should change
  };

  [[nodiscard]] static bool has_means(const search::Expected& now) {
    return std::ranges::all_of(now.mean, [](double mean) { return std::isfinite(mean); });
  }

  [[nodiscard]] Correction correction(const search::Expected& now) const {
    Correction found;
    found.next = search::step(whole_problem(now), x_, now.mean, now.jacobian, 0, farthest, &found.low, &found.high);
    Eigen::VectorXd change(static_cast<Eigen::Index>(x_.size()));
    for (std::size_t k = 0; k < x_.size(); ++k) change[static_cast<Eigen::Index>(k)] = found.next[k] - x_[k];
    found.results = now.jacobian * change;
    return found;
  }

  void take(const Correction& correction) {
    x_ = correction.next;
    bounded_.clear();
    for (std::size_t k = 0; k < x_.size(); ++k) {
      if (!lost_[k] && (correction.low[k] || correction.high[k])) bounded_.push_back({k, correction.high[k]});
    }
  }

  /// Whether a correction changes so little that it would follow the noise.
  [[nodiscard]] bool is_small(const Correction& correction, const search::Expected& now) const {
    const search::Problem problem = whole_problem(now);
    for (std::size_t i = 0; i < now.mean.size(); ++i) {
      if (std::abs(correction.results[static_cast<Eigen::Index>(i)]) > problem.targets[i].close) return false;
    }
    return true;
  }

  /// Whether a correction need not be tested again: no result changes by more than the seeds tell.
  [[nodiscard]] static bool is_within_scatter(const Correction& correction, const search::Expected& now) {
    for (std::size_t i = 0; i < now.mean.size(); ++i) {
      if (std::abs(correction.results[static_cast<Eigen::Index>(i)]) > 2 * now.deviation[i]) return false;
    }
    return true;
  }

  /// One seed stands for all while searching. Now means over fresh ones are brought to the targets: two more at each step, whose
  /// results add up, until they tell as much as the laboratory knows or the budget is left for the last round alone.
  void confirm() {
    search::Expected now;
    if (!samples_.empty()) now = expected();
    bool thorough = false;
    for (int round = 1, last_rounds = 0;; ++round) {
      bool settled = false;
      if (!samples_.empty() && has_means(now)) {
        const Correction next = correction(now);
        settled = is_told(now) && is_small(next, now);
        const int least = plan_.seeds * static_cast<int>(telling_tests(now).size());
        if (thorough && (settled || left() < least || last_rounds == most_rounds)) break;
        if (!settled) {
          take(next);
          now = expected();
        }
      }
      std::vector<Test> tests = telling_tests(now);
      thorough = settled || left() < (seeds_of_a_step + plan_.seeds) * static_cast<int>(tests.size());
      // The last round shows all, where the budget allows.
      const std::vector<Test> all = confirming_tests();
      if (thorough && left() >= plan_.seeds * static_cast<int>(all.size())) tests = all;
      last_rounds += thorough;
      test_fresh(round, thorough ? plan_.seeds : seeds_of_a_step, tests);
      now = expected();
      if (std::ranges::any_of(now.specimens, [](int count) { return count < 2; })) {
        result_.problems.push_back(fmt::format(
            "With fresh seeds some tests gave no result{}. Nothing is confirmed: look at these tests alone.",
            error_.empty() ? std::string() : ": " + error_));
        return;
      }
    }
    if (const Correction last = correction(now); !is_small(last, now) && is_within_scatter(last, now)) {
      take(last);
      now = expected();
    }
    Step end{"mean", factors(x_), {}};
    const auto [fewest, most] = std::ranges::minmax_element(now.specimens);
    end.seeds = *fewest;
    end.most_seeds = *most;
    end.is_best = true;
    for (std::size_t i = 0; i < now.mean.size(); ++i)
      end.values.push_back(result_.subject.targets[i].from_search(now.mean[i]));
    result_.specimens = end.specimens();
    result_.path.push_back(std::move(end));
    jacobian_ = now.jacobian;
    means_ = std::move(now);
  }

  void finish() {
    result_.tests = used();
    result_.steps = trials_.steps() - steps_before_;
    finish_parameters();
    finish_targets();
    find_advice();
    result_.is_met = result_.problems.empty();
  }

  void finish_parameters() {
    const std::size_t n = moved_.size();
    search::Expected now;
    if (means_) {
      now = *means_;
    } else {
      for (const Target& target : result_.subject.targets) {
        now.deviation.push_back(scatter(target.number.key));
        now.freedom.push_back(known_freedom);
      }
    }
    const search::Problem problem = whole_problem(now);
    Eigen::MatrixXd weighed = jacobian_;
    for (std::size_t i = 0; i < problem.targets.size(); ++i)
      weighed.row(static_cast<Eigen::Index>(i)) /= problem.targets[i].deviation;
    const search::Identified known = search::identify(weighed, undetermined);
    const Eigen::MatrixXd spread = search::covariance(weighed, known.free);
    result_.condition = known.condition;
    const double wide = dem::analysis::student_limit(0.05, *std::ranges::min_element(now.freedom));
    // What is left to be taken out lies inside the interval as well.
    const std::vector<double> best = means_ ? search::step(problem, x_, now.mean, jacobian_, 0, farthest) : x_;
    result_.correlation = Eigen::MatrixXd::Identity(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n));
    for (std::size_t k = 0; k < n; ++k) {
      const auto at = static_cast<Eigen::Index>(k);
      const double deviation = std::sqrt(std::max(spread(at, at), 0.0));
      ParameterResult one{result_.subject.moved[k],
                          std::exp(x_[k]),
                          std::exp(std::min(x_[k], best[k]) - wide * deviation),
                          std::exp(std::max(x_[k], best[k]) + wide * deviation),
                          {}};
      one.is_determined = known.free[k] && !lost_[k];
      for (const double start : moved_[k].start) one.values.push_back(rounded(start * std::exp(x_[k]), moved_[k].unit));
      for (const auto& [place, high] : bounded_) {
        if (place == k && std::abs(x_[k] - std::log(high ? moved_[k].high : moved_[k].low)) < 1e-9)
          (high ? one.at_high : one.at_low) = true;
      }
      for (std::size_t j = 0; j < n; ++j) {
        const auto other = static_cast<Eigen::Index>(j);
        const double both = std::sqrt(std::max(spread(at, at) * spread(other, other), 1e-300));
        if (j != k) result_.correlation(at, other) = spread(at, other) / both;
      }
      result_.parameters.push_back(std::move(one));
    }
  }

  void finish_targets() {
    std::vector<std::string> missed;
    for (std::size_t i = 0; means_ && i < result_.subject.targets.size(); ++i) {
      const Target& target = result_.subject.targets[i];
      const double mean = means_->mean[i],
                   half = dem::analysis::student_limit(0.05, means_->freedom[i]) * means_->deviation[i];
      TargetResult one;
      one.ours = {target.from_search(mean), target.from_search(mean - half), target.from_search(mean + half)};
      one.specimens = means_->specimens[i];
      one.deviation = means_->scatter[i] * (target.is_logarithmic() ? one.ours.value : 1);
      const auto [low, high] = band_of(target);
      one.verdict = reports::judge_value(one.ours.value, one.ours, {low, high});
      if (one.verdict == Verdict::missed) missed.push_back(deviation_words(target, one.ours.value));
      result_.targets.push_back(one);
    }
    for (const auto& [check, count] : broken_) {
      result_.problems.push_back(fmt::format(
          "The check {} did not hold in {} of {} tests with fresh seeds: what they gave is not sure. Run the "
          "scenario with the calibrated rock to see why; most often the loading is too fast.",
          reports::words(check), count, fresh_tests_));
    }
    if (missed.empty()) return;
    const std::string what = fmt::format("Not met: {}.", reports::listed(missed));
    std::vector<std::string> ends;
    for (const ParameterResult& one : result_.parameters) {
      if (!one.at_low && !one.at_high) continue;
      const Parameter& parameter = result_.subject.candidates[one.candidate];
      ends.push_back(fmt::format("{} came to the {} end of its range, {:.3g} times the start", parameter.name,
                                 one.at_high ? "upper" : "lower", one.factor));
    }
    if (!ends.empty()) {
      result_.problems.push_back(fmt::format("{} {}: widen it in calibrate.ranges, or let other parameters move.", what,
                                             reports::listed(ends)));
    } else if (exhausted_ || left() < plan_.seeds * static_cast<int>(confirming_tests().size())) {
      result_.problems.push_back(
          fmt::format("{} The budget of {} tests is used up: raise calibrate.budget; what was run is kept.", what,
                      result_.subject.budget));
    } else {
      result_.problems.push_back(
          fmt::format("{} The parameters that move ({}) cannot have all of these values at once: let others move in "
                      "calibrate.parameters, or look at the measured values.",
                      what, moved_names()));
    }
  }

  [[nodiscard]] std::string moved_names() const {
    std::vector<std::string> names;
    for (const Parameter& one : moved_) names.push_back(one.name);
    return reports::listed(names);
  }

  /// For each parameter that was kept: which value, if it were measured to a few percent, would determine it best.
  void find_advice() {
    const Subject& subject = result_.subject;
    Eigen::MatrixXd weighed = known_derivatives(subject, subject.candidates);
    for (std::size_t i = 0; i < subject.targets.size(); ++i)
      weighed.row(static_cast<Eigen::Index>(i)) /= expected_deviation(subject.targets[i], plan_.seeds);
    struct Offer {
      const char *key, *words;
      double pressure, deviation;
    };
    constexpr std::array offers{Offer{"young_modulus", "Young’s modulus", 0, 0.03},
                                Offer{"poisson_ratio", "Poisson’s ratio", 0, 0.02},
                                Offer{"ucs", "the uniaxial compressive strength", 0, 0.04},
                                Offer{"tensile_strength", "the tensile strength", 0, 0.06},
                                Offer{"brazilian_strength", "the Brazilian strength of discs", 0, 0.07},
                                Offer{"crack_initiation", "crack initiation", 0, 0.08},
                                Offer{"crack_damage", "crack damage", 0, 0.06},
                                Offer{"peaks", "peaks under confining pressure, 20 MPa or more", 20, 0.04}};
    for (const search::Kept& kept : subject.known.kept) {
      std::vector<bool> free = subject.known.free;
      free[kept.unknown] = true;
      Advice best{kept.unknown, "", undetermined};
      for (const Offer& offer : offers) {
        const bool there =
            std::ranges::any_of(subject.targets, [&](const Target& t) { return t.number.key == offer.key; });
        if (there) continue;
        Eigen::RowVectorXd row(static_cast<Eigen::Index>(subject.candidates.size()));
        for (std::size_t k = 0; k < subject.candidates.size(); ++k)
          row[static_cast<Eigen::Index>(k)] =
              sensitivity(subject.candidates[k].kind, offer.key, offer.pressure, subject.mineral.empty()) /
              offer.deviation;
        Eigen::MatrixXd more(weighed.rows() + 1, weighed.cols());
        more << weighed, row;
        if (!search::identify(more, undetermined).free[kept.unknown]) continue;
        const double deviation = search::deviations_with(weighed, row, free)[kept.unknown];
        if (deviation < best.deviation) best = {kept.unknown, offer.words, deviation};
      }
      result_.advice.push_back(best);
    }
  }

  const dem::Study& study_;
  const Plan& plan_;
  Values given_;
  Trials& trials_;
  const std::function<void(const std::string&)>& say_;
  int tests_before_;
  double steps_before_;
  SubjectResult result_;
  std::vector<Parameter> moved_;
  std::vector<double> x_;  ///< logarithms of factors
  Eigen::MatrixXd jacobian_;
  std::vector<std::pair<std::size_t, bool>> bounded_;
  std::vector<bool> lost_;                 ///< parameters to which the tests did not react
  std::vector<search::Sample> samples_;    ///< whole tests, by which the means are known
  int fresh_seeds_ = 0;                    ///< that were tested
  int fresh_tests_ = 0;                    ///< of them
  std::string error_;                      ///< the first of them that failed
  std::map<std::string, int> broken_;      ///< checks that did not hold with them, and in how many tests
  std::optional<search::Expected> means_;  ///< at the end; none: not confirmed
  bool exhausted_ = false;
};

}  // namespace

std::string Step::specimens() const {
  return most_seeds > seeds ? fmt::format("{} to {}", seeds, most_seeds) : fmt::format("{}", seeds);
}

bool Outcome::is_met() const { return std::ranges::all_of(subjects, &SubjectResult::is_met); }

Outcome calibrate(const dem::Study& study, const Plan& plan, const dem::StudyOptions& options,
                  const Listener& listener) {
  Outcome outcome;
  Trials trials(study, options, listener.tests, listener.starting);
  for (const Subject& subject : plan.subjects) {
    Subject now = subject;
    // What a mineral alone has been brought to is where the rock starts.
    for (Parameter& parameter : now.candidates) {
      for (std::size_t i = 0; i < parameter.keys.size(); ++i) {
        if (const auto at = outcome.values.find(parameter.keys[i]); at != outcome.values.end())
          parameter.start[i] = at->second;
      }
    }
    Work work(study, plan, now, outcome.values, trials, listener.say);
    outcome.subjects.push_back(work.run());
    for (const auto& [key, value] : work.values()) outcome.values[key] = value;
  }
  outcome.simulated = trials.simulated();
  outcome.seconds = trials.seconds();
  return outcome;
}

}  // namespace calibrate
