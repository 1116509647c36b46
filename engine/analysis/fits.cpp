#include "engine/analysis/fits.h"

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>

#include "engine/analysis/statistics.h"

namespace dem::analysis {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr double outside = 0.05;  // of a 95 % interval

// Where Student's t has no answer, NaN or infinity is the answer: nothing is thrown.
namespace policies = boost::math::policies;
using Quiet =
    policies::policy<policies::domain_error<policies::ignore_error>, policies::pole_error<policies::ignore_error>,
                     policies::overflow_error<policies::ignore_error>,
                     policies::evaluation_error<policies::ignore_error>>;
using Student = boost::math::students_t_distribution<double, Quiet>;

Eigen::Map<const Eigen::ArrayXd> array(std::span<const double> values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

bool two_places(std::span<const double> x) {
  const auto [low, high] = std::ranges::minmax(x);
  return high > low;
}

// Pairs that an envelope can be fitted to.
bool usable(std::span<const double> x, std::span<const double> y) {
  return x.size() >= 2 && x.size() == y.size() && two_places(x) && array(x).isFinite().all() &&
         array(y).isFinite().all();
}

Estimate with_error(double value, double error, double freedom) {
  if (freedom < 1) return {value, none, none};
  const double half = student_limit(outside, freedom) * error;
  return {value, value - half, value + half};
}

Estimate fixed_value(double value) { return {value, value, value}; }

/// Residuals of a model with N unknowns, and the derivatives of its values.
template <int N>
struct Linear {
  Eigen::VectorXd residual;
  Eigen::Matrix<double, Eigen::Dynamic, N> slopes;
};

/// The unknowns of least squares, and the inverse of the normal matrix there.
template <int N>
struct Minimum {
  Eigen::Vector<double, N> at;
  Eigen::Matrix<double, N, N> inverse;
  double squares = 0;
};

// Levenberg and Marquardt. A model says nothing where it has no value: such steps are shortened, like those that raise the
// squares, which is why this is not one of Eigen's solvers. `linear`: unknowns -> optional<Linear<N>>.
template <int N, class Model>
std::optional<Minimum<N>> least_squares(Eigen::Vector<double, N> at, const Model& linear) {
  constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
  std::optional<Linear<N>> now = linear(at);
  if (!now) return std::nullopt;
  double damping = 1e-6;
  for (int step = 0; step < 500 && damping < 1e12; ++step) {
    Eigen::Matrix<double, N, N> normal = now->slopes.transpose() * now->slopes;
    normal.diagonal() *= 1 + damping;
    const Eigen::Vector<double, N> change = normal.ldlt().solve(now->slopes.transpose() * now->residual);
    const std::optional<Linear<N>> next = linear(at + change);
    if (!next || !(next->residual.squaredNorm() <= now->residual.squaredNorm() * (1 + rounding))) {
      damping *= 10;
      continue;
    }
    at += change;
    now = next;
    damping = std::max(1e-12, damping / 10);
    if ((change.array().abs() <= 1e-13 * at.array().abs()).all()) break;
  }
  const Eigen::LDLT<Eigen::Matrix<double, N, N>> normal(now->slopes.transpose() * now->slopes);
  if (!(normal.vectorD().array() > 0).all()) return std::nullopt;
  return Minimum<N>{at, normal.solve(Eigen::Matrix<double, N, N>::Identity()), now->residual.squaredNorm()};
}

/// sigma_1 = sigma_3 + sqrt(a sigma_3 + b), both envelopes, with a = m sigma_c and b = s sigma_c^2; derivatives by a and b.
std::optional<Linear<2>> root_envelope(std::span<const double> sigma_3, std::span<const double> sigma_1, double a,
                                       double b) {
  const auto x = array(sigma_3), y = array(sigma_1);
  const Eigen::ArrayXd inside = a * x + b;
  if (!(inside > 0).all()) return std::nullopt;
  const Eigen::ArrayXd root = inside.sqrt();
  Linear<2> linear{y - x - root, Eigen::MatrixX2d(x.size(), 2)};
  linear.slopes.col(0) = x / (2 * root);
  linear.slopes.col(1) = 1 / (2 * root);
  return linear;
}

// Both a and b, from the straight line through (sigma_1 - sigma_3)^2.
std::optional<Minimum<2>> fit_root(std::span<const double> x, std::span<const double> y) {
  if (!usable(x, y)) return std::nullopt;
  const auto model = [&](const Eigen::Vector2d& at) { return root_envelope(x, y, at[0], at[1]); };
  const Eigen::ArrayXd squared = (array(y) - array(x)).square();
  const auto line = fit_line(x, {squared.data(), x.size()});
  const Eigen::Vector2d start(line->slope.value, line->intercept.value), level(0, squared.mean());
  return least_squares<2>(model(start) ? start : level, model);
}

// An estimate of a function of a and b with these derivatives.
Estimate derived(const Minimum<2>& fit, std::size_t points, double value, const Eigen::Vector2d& slopes) {
  const double freedom = static_cast<double>(points) - 2;
  const double variance = freedom > 0 ? fit.squares / freedom * slopes.dot(fit.inverse * slopes) : 0;
  return with_error(value, std::sqrt(std::max(0.0, variance)), freedom);
}

}  // namespace

bool Estimate::has_interval() const { return std::isfinite(low) && std::isfinite(high); }

Estimate mean_of(std::span<const double> values) {
  constexpr std::size_t fewest = 3;  // the interval of two is some ten times their distance
  const Spread known = spread(values);
  if (known.count < fewest) return {known.mean, none, none};
  const auto count = static_cast<double>(known.count);
  return with_error(known.mean, known.deviation / std::sqrt(count), count - 1);
}

Trend paired_trend(std::span<const double> slopes) {
  Trend all{mean_of(slopes), none, slopes.size()};
  if (!all.slope.has_interval()) return all;
  const auto [mean, deviation, count] = spread(slopes);
  const auto n = static_cast<double>(count);
  all.p_value = deviation > 0 ? student_two_sided(mean / (deviation / std::sqrt(n)), n - 1) : mean == 0 ? 1 : 0;
  return all;
}

Estimate ratio_of_means(std::span<const double> a, std::span<const double> b) {
  const Spread one = spread(a), two = spread(b);
  const double ratio = one.mean / two.mean;
  constexpr std::size_t fewest = 3;
  if (!std::isfinite(ratio) || one.count < fewest || two.count < fewest) return {ratio, none, none};
  const auto variance = [](const Spread& of) {
    return of.deviation * of.deviation / static_cast<double>(of.count) / (of.mean * of.mean);
  };
  const double v1 = variance(one), v2 = variance(two), sum = v1 + v2;
  const double freedom =
      sum > 0
          ? sum * sum / (v1 * v1 / static_cast<double>(one.count - 1) + v2 * v2 / static_cast<double>(two.count - 1))
          : static_cast<double>(one.count + two.count - 2);
  return with_error(ratio, std::abs(ratio) * std::sqrt(sum), freedom);
}

double student_two_sided(double t, double freedom) { return 2 * cdf(complement(Student(freedom), std::abs(t))); }

double student_limit(double probability, double freedom) {
  return quantile(complement(Student(freedom), probability / 2));
}

std::optional<LineFit> fit_line(std::span<const double> x, std::span<const double> y) {
  if (x.size() < 2 || x.size() != y.size() || !two_places(x)) return std::nullopt;
  const auto n = static_cast<double>(x.size());
  const double mean_x = array(x).mean(), mean_y = array(y).mean();
  const Eigen::VectorXd off_x = array(x) - mean_x, off_y = array(y) - mean_y;
  const double xx = off_x.squaredNorm(), slope = off_x.dot(off_y) / xx;
  const double freedom = n - 2;
  const double deviation = freedom > 0 ? (off_y - slope * off_x).norm() / std::sqrt(freedom) : 0;
  const double slope_error = deviation / std::sqrt(xx);
  LineFit fit;
  fit.points = x.size();
  fit.r_squared = off_y.squaredNorm() > 0 ? 1 - (off_y - slope * off_x).squaredNorm() / off_y.squaredNorm() : none;
  fit.slope = with_error(slope, slope_error, freedom);
  fit.intercept = with_error(mean_y - slope * mean_x, deviation * std::sqrt(1 / n + mean_x * mean_x / xx), freedom);
  fit.p_value = freedom < 1       ? none
                : slope_error > 0 ? student_two_sided(slope / slope_error, freedom)
                : slope == 0      ? 1
                                  : 0;
  return fit;
}

double hoek_brown(double sigma_3, double sigma_c, double m, double s) {
  return sigma_3 + sigma_c * std::sqrt(m * sigma_3 / sigma_c + s);
}

double EnvelopeFit::at(double sigma_3) const { return hoek_brown(sigma_3, sigma_c.value, m.value, s.value); }

std::optional<EnvelopeFit> fit_peak_envelope(std::span<const double> sigma_3, std::span<const double> sigma_1) {
  const auto root = fit_root(sigma_3, sigma_1);
  if (!root || !(root->at[1] > 0)) return std::nullopt;
  const double a = root->at[0], c = std::sqrt(root->at[1]);
  const std::size_t points = sigma_3.size();
  return EnvelopeFit{derived(*root, points, c, {0, 0.5 / c}),
                     derived(*root, points, a / c, {1 / c, -0.5 * a / (c * c * c)}), fixed_value(1), points};
}

std::optional<EnvelopeFit> fit_peak_m(std::span<const double> sigma_3, std::span<const double> sigma_1,
                                      double sigma_c) {
  if (!usable(sigma_3, sigma_1) || !(sigma_c > 0)) return std::nullopt;
  const auto model = [&](const Eigen::Vector<double, 1>& at) -> std::optional<Linear<1>> {
    const auto both = root_envelope(sigma_3, sigma_1, at[0], sigma_c * sigma_c);
    if (!both) return std::nullopt;
    return Linear<1>{both->residual, both->slopes.col(0)};
  };
  const auto fit = least_squares<1>(Eigen::Vector<double, 1>(10 * sigma_c), model);
  if (!fit) return std::nullopt;
  // Points without pressure say nothing of m, and sigma_c is their mean: scatter is that of the others.
  const double m = fit->at[0] / sigma_c;
  double squares = 0, freedom = -1;
  for (std::size_t i = 0; i < sigma_3.size(); ++i) {
    if (!(sigma_3[i] > 0)) continue;
    squares += std::pow(sigma_1[i] - hoek_brown(sigma_3[i], sigma_c, m, 1), 2);
    ++freedom;
  }
  const double error = freedom > 0 ? std::sqrt(squares / freedom * fit->inverse(0, 0)) / sigma_c : 0;
  return EnvelopeFit{fixed_value(sigma_c), with_error(m, error, freedom), fixed_value(1), sigma_3.size()};
}

std::optional<EnvelopeFit> fit_damage_envelope(std::span<const double> sigma_3, std::span<const double> sigma_1,
                                               double sigma_c) {
  const auto root = fit_root(sigma_3, sigma_1);
  if (!root || !(sigma_c > 0)) return std::nullopt;
  const double square = sigma_c * sigma_c;
  const std::size_t points = sigma_3.size();
  return EnvelopeFit{fixed_value(sigma_c), derived(*root, points, root->at[0] / sigma_c, {1 / sigma_c, 0}),
                     derived(*root, points, root->at[1] / square, {0, 1 / square}), points};
}

}  // namespace dem::analysis
