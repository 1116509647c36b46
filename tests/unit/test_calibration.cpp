// The search for parameters, on functions whose answer is known: bounds, noise, directions that nothing sees, evaluations
// that fail.
#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "engine/calibration/identify.h"
#include "engine/calibration/least_squares.h"
#include "engine/calibration/mean_response.h"

namespace {

using namespace dem::calibration;
using Point = std::vector<double>;

/// One at a time, and counted.
Evaluate one_by_one(const std::function<Answer(const Point&)>& f, int& count) {
  return [f, &count](const std::vector<Point>& points) {
    std::vector<Answer> answers;
    for (const Point& point : points) {
      answers.push_back(f(point));
      ++count;
    }
    return answers;
  };
}

/// Logarithms of E, UCS and TS of something like a mineral, by those of modulus, cohesion and tensile strength.
Point mineral(const Point& x) {
  return {x[0] - 0.05 * x[1] * x[1], -0.15 * x[0] + 0.35 * x[1] + 0.09 * x[2] + 0.08 * x[1] * x[1],
          0.97 * x[2] - 0.1 * x[0]};
}

Problem mineral_problem() {
  Problem problem;
  problem.unknowns.assign(3, {0, std::log(0.3), std::log(3.0)});
  const Point truth = mineral({0.3, 0.6, -0.4});
  for (const double value : truth) problem.targets.push_back({value, 0.02, 0.002, 0.0, 1});
  problem.jacobian = Eigen::MatrixXd{{1, 0, 0}, {-0.15, 0.35, 0}, {0, 0, 1}};
  return problem;
}

}  // namespace

TEST_CASE("a search with rough derivatives finds the answer in a few evaluations") {
  const Problem problem = mineral_problem();
  int count = 0;
  const Solution found = search(problem, one_by_one([](const Point& x) { return Answer(mineral(x)); }, count));
  CHECK(found.ending == Ending::met);
  CHECK(count <= 8);
  CHECK(static_cast<int>(found.path.size()) == count);
  CHECK(found.point[0] == doctest::Approx(0.3).epsilon(0.02));
  CHECK(found.point[1] == doctest::Approx(0.6).epsilon(0.03));
  CHECK(found.point[2] == doctest::Approx(-0.4).epsilon(0.02));
  // What it has learnt: TS falls with the modulus, which was not known beforehand.
  CHECK(found.jacobian(2, 0) < 0);
}

TEST_CASE("derivatives that mislead are measured, and the answer is found all the same") {
  Problem problem = mineral_problem();
  problem.jacobian = Eigen::MatrixXd{{-1, 0, 0}, {0, -0.35, 0}, {0, 0, -1}};
  int count = 0;
  const Solution found =
      search(problem, one_by_one([](const Point& x) { return Answer(mineral(x)); }, count), {.evaluations = 30});
  CHECK(found.ending == Ending::met);
  CHECK(found.point[1] == doctest::Approx(0.6).epsilon(0.03));
}

TEST_CASE("a bound that excludes the answer holds, and is told") {
  Problem problem = mineral_problem();
  problem.unknowns[1].high = 0.2;
  int count = 0;
  const Solution found = search(problem, one_by_one([](const Point& x) { return Answer(mineral(x)); }, count));
  CHECK(found.ending == Ending::settled);
  CHECK(found.point[1] == 0.2);
  CHECK(found.at_high[1]);
  CHECK_FALSE(found.at_low[1]);
  CHECK_FALSE(found.at_high[0]);
  // The others are the best beside it: E is met though UCS is not.
  CHECK(mineral(found.point)[0] == doctest::Approx(problem.targets[0].value).epsilon(0.05));
  for (const Trial& trial : found.path) CHECK(trial.point[1] <= 0.2);
}

TEST_CASE("a step that is cut short in one unknown is found anew in the others") {
  Problem problem;
  problem.unknowns.assign(2, {0, -2, 2});
  problem.targets = {{0, 0.01}, {0.2, 0.1}};  // the second wants 1 of the second unknown
  const Eigen::MatrixXd jacobian{{1, 0.5}, {0, 0.2}};
  std::vector<bool> low, high;
  const std::vector<double> whole = step(problem, {0, 0}, {0, 0}, jacobian, 0, 2);
  CHECK(whole[0] == doctest::Approx(-0.5));
  CHECK(whole[1] == doctest::Approx(1));
  const std::vector<double> cut = step(problem, {0, 0}, {0, 0}, jacobian, 0, 0.3, &low, &high);
  CHECK(cut[1] == doctest::Approx(0.3));
  CHECK(cut[0] == doctest::Approx(-0.15));  // the first target stays met
  CHECK_FALSE((low[0] || low[1] || high[0] || high[1]));
}

TEST_CASE("noise as large as that of seeds does not lead the search astray") {
  int met = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Problem problem = mineral_problem();
    for (Target& target : problem.targets) {
      target.noise = 0.01;
      target.close = 0.01;
    }
    std::mt19937 random(seed);
    const auto noisy = [&](const Point& x) {
      Point y = mineral(x);
      for (double& value : y) value += 0.01 * (static_cast<double>(random()) / 0x1p31 - 1);
      return Answer(y);
    };
    int count = 0;
    const Solution found = search(problem, one_by_one(noisy, count), {.evaluations = 15});
    CHECK(count <= 15);
    if (std::abs(found.point[1] - 0.6) < 0.12 && std::abs(found.point[0] - 0.3) < 0.05) ++met;
  }
  CHECK(met >= 18);
}

TEST_CASE("evaluations that fail shorten the step; a start that fails ends the search") {
  Problem problem = mineral_problem();
  problem.jacobian(1, 1) = 0.15;  // the first step goes too far
  int count = 0;
  const auto some_fail = [](const Point& x) { return x[1] > 0.65 ? Answer() : Answer(mineral(x)); };
  const Solution found = search(problem, one_by_one(some_fail, count), {.evaluations = 30});
  CHECK(found.ending == Ending::met);
  CHECK(std::ranges::any_of(found.path, [](const Trial& trial) { return !trial.answer; }));
  const Solution none = search(problem, one_by_one([](const Point&) { return Answer(); }, count));
  CHECK(none.ending == Ending::failed);
  CHECK(none.path.size() == 1);
  // An answer that is not a number is no answer.
  const Solution nan = search(problem, one_by_one(
                                           [](const Point& x) {
                                             return Answer({x[0], std::nan(""), 1.0});
                                           },
                                           count));
  CHECK(nan.ending == Ending::failed);
}

TEST_CASE("a search that has no evaluations left says so") {
  int count = 0;
  const Solution found = search(mineral_problem(), one_by_one([](const Point& x) { return Answer(mineral(x)); }, count),
                                {.evaluations = 2});
  CHECK(found.ending == Ending::exhausted);
  CHECK(count == 2);
}

TEST_CASE("the same search gives the same path, to the bit") {
  int count = 0;
  const auto run = [&] {
    return search(mineral_problem(), one_by_one([](const Point& x) { return Answer(mineral(x)); }, count));
  };
  const Solution a = run(), b = run();
  REQUIRE(a.path.size() == b.path.size());
  for (std::size_t i = 0; i < a.path.size(); ++i) CHECK(a.path[i].point == b.path[i].point);
}

TEST_CASE("what no target sees is kept, with the direction") {
  // Two targets; the third unknown does nothing, and the fourth what the first does.
  const Eigen::MatrixXd weighed{{50.0, 0.0, 0.0, 50.0}, {0.0, 20.0, 0.0, 0.0}};
  const Identified found = identify(weighed, 0.35);
  CHECK(found.free == std::vector<bool>{true, true, false, false});
  REQUIRE(found.kept.size() == 2);
  CHECK(found.kept[0].unknown == 2);
  CHECK(std::isinf(found.kept[0].deviation));
  CHECK(found.kept[0].direction[2] == doctest::Approx(1));
  // The fourth against the first, by equal parts.
  CHECK(found.kept[1].unknown == 3);
  CHECK(found.kept[1].direction[3] == doctest::Approx(std::sqrt(0.5)));
  CHECK(found.kept[1].direction[0] == doctest::Approx(-std::sqrt(0.5)));
  CHECK(found.condition == doctest::Approx(2.5));
  CHECK(std::isinf(found.condition_of_all));
  // What would determine the third: a quantity that it moves.
  const Eigen::RowVectorXd row{{0.0, 0.0, 10.0, 0.0}};
  std::vector<bool> free = found.free;
  free[2] = true;
  CHECK(deviations_with(weighed, row, free)[2] == doctest::Approx(0.1));
}

TEST_CASE("an unknown that is seen too badly is kept as well") {
  const Eigen::MatrixXd weighed{{50.0, 0.0}, {0.0, 2.0}};
  CHECK(identify(weighed, 0.35).free == std::vector<bool>{true, false});
  CHECK(identify(weighed, 0.6).free == std::vector<bool>{true, true});
  CHECK(identify(weighed, 0.35).kept.front().deviation == doctest::Approx(0.5));
}

TEST_CASE("the covariance is that of linear least squares") {
  const Eigen::MatrixXd weighed{{10.0, 0.0}, {5.0, 5.0}};
  const Eigen::MatrixXd found = covariance(weighed, {true, true});
  const Eigen::MatrixXd expected = (weighed.transpose() * weighed).inverse();
  CHECK((found - expected).norm() < 1e-12);
  CHECK(covariance(weighed, {true, false})(0, 0) == doctest::Approx(1.0 / 125));
  CHECK(covariance(weighed, {true, false})(1, 1) == 0);
}

TEST_CASE("stated intervals of 95 % hold the truth in 95 of 100 noisy data") {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  const Eigen::MatrixXd jacobian{{1.0, 0.0, 0.0}, {-0.15, 0.35, 0.09}, {-0.1, 0.0, 0.97}, {0.05, 0.62, 0.11}};
  const Point deviations{0.005, 0.02, 0.03, 0.02};
  Eigen::MatrixXd weighed = jacobian;
  for (Eigen::Index i = 0; i < 4; ++i) weighed.row(i) /= deviations[static_cast<std::size_t>(i)];
  const Eigen::MatrixXd spread = covariance(weighed, {true, true, true});
  int inside = 0, all = 0;
  for (int k = 0; k < 200; ++k) {
    Problem problem;
    problem.unknowns.assign(3, {0, -1, 1});
    problem.jacobian = jacobian;
    const Eigen::Vector3d truth(0.1, 0.2, -0.1);
    const Eigen::VectorXd exact = jacobian * truth;
    for (Eigen::Index i = 0; i < 4; ++i) {
      const double deviation = deviations[static_cast<std::size_t>(i)];
      problem.targets.push_back({exact[i] + deviation * normal(random), deviation, 1e-9, 0, 1});
    }
    int count = 0;
    const auto linear = [&](const Point& x) {
      const Eigen::VectorXd y = jacobian * Eigen::Vector3d(x[0], x[1], x[2]);
      return Answer(Point(y.data(), y.data() + y.size()));
    };
    const Solution found = search(problem, one_by_one(linear, count));
    for (Eigen::Index i = 0; i < 3; ++i) {
      ++all;
      if (std::abs(found.point[static_cast<std::size_t>(i)] - truth[i]) < 1.96 * std::sqrt(spread(i, i))) ++inside;
    }
  }
  CHECK(inside > 0.92 * all);
  CHECK(inside < 0.98 * all);
}

namespace {

/// Two unknowns, one target: 3 + 2 x - y, and what is known of it beforehand.
Prior line_prior() {
  Prior prior;
  prior.jacobian = Eigen::MatrixXd{{1.7, -0.8}};
  prior.scale = {1};
  prior.scatter = {0.03};
  return prior;
}
double line(const Point& x) { return 3 + 2 * x[0] - x[1]; }

double standard_normal(std::mt19937& random) {
  double sum = 0;
  for (int i = 0; i < 12; ++i) sum += static_cast<double>(random()) / 0x1p32;
  return sum - 6;
}

}  // namespace

TEST_CASE("means of specimens at several points add up, and teach the derivatives") {
  Prior prior = line_prior();
  prior.curvature = 0;
  std::vector<Sample> samples;
  for (const Point& x : {Point{0, 0}, Point{0.2, 0}, Point{0, 0.2}, Point{0.2, 0.2}})
    samples.push_back({x, {{line(x) - 1e-6, line(x) + 1e-6}}});
  prior.scatter = {1e-6};
  const Expected found = expected_at({0.1, 0.1}, samples, prior);
  CHECK(found.mean[0] == doctest::Approx(line({0.1, 0.1})).epsilon(1e-9));
  CHECK(found.jacobian(0, 0) == doctest::Approx(2).epsilon(1e-5));
  CHECK(found.jacobian(0, 1) == doctest::Approx(-1).epsilon(1e-5));
  CHECK(found.specimens[0] == 8);
  // In the middle of the points, eight specimens are worth eight.
  CHECK(found.deviation[0] == doctest::Approx(found.scatter[0] / std::sqrt(8)).epsilon(1e-6));
}

TEST_CASE("a specimen far away counts less than one at the point") {
  const Prior prior = line_prior();
  const auto deviation = [&](const Point& x) {
    return expected_at({0, 0}, {{{0, 0}, {{3.0, 3.0}}}, {x, {{3.0, 3.0}}}}, prior).deviation[0];
  };
  CHECK(deviation({0, 0}) == doctest::Approx(0.03 * std::sqrt(4.0 / 6) / 2));  // 4 + 1 + 1 degrees of freedom
  CHECK(deviation({0.1, 0}) > 1.1 * deviation({0, 0}));
  CHECK(deviation({0.5, 0}) > deviation({0.1, 0}));
  CHECK(deviation({0.5, 0}) <= expected_at({0, 0}, {{{0, 0}, {{3.0, 3.0}}}}, prior).deviation[0] * 1.2);
}

TEST_CASE("specimens that scatter more than is known raise the deviation; a target without a value has no mean") {
  const Prior prior = line_prior();
  const Expected wild = expected_at({0, 0}, {{{0, 0}, {{2.8, 2.9, 3.0, 3.1, 3.2}}}}, prior);
  CHECK(wild.scatter[0] == doctest::Approx(std::sqrt(0.1 / 4)));
  CHECK(wild.freedom[0] == 8);
  const Expected none = expected_at({0, 0}, {{{0, 0}, {{}}}}, prior);
  CHECK(std::isnan(none.mean[0]));
  CHECK(none.specimens[0] == 0);
}

TEST_CASE("intervals of the mean hold the truth as often as they say") {
  std::mt19937 random(7);
  int held = 0;
  constexpr int trials = 1000;
  for (int trial = 0; trial < trials; ++trial) {
    std::vector<Sample> samples;
    Point x{0.1, -0.1};
    for (int round = 0; round < 6; ++round) {
      samples.push_back({x, {{}}});
      for (int specimen = 0; specimen < 2; ++specimen)
        samples.back().values[0].push_back(line(x) + 0.03 * standard_normal(random));
      for (double& value : x) value *= 0.6;  // towards the place that is asked for, as a search goes
    }
    const Expected found = expected_at({0, 0}, samples, line_prior());
    held += std::abs(found.mean[0] - 3) <= 2.23 * found.deviation[0];  // Student's t, 10 degrees of freedom
  }
  CHECK(held >= 0.93 * trials);
  CHECK(held <= 0.985 * trials);
}
