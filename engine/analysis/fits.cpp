#include "engine/analysis/fits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace dem::analysis {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr double outside = 0.05;  // of a 95 % interval

// Regularised incomplete beta function by Lentz's continued fraction; converges for x < (a + 1) / (a + b + 2).
double beta_fraction(double a, double b, double x) {
  constexpr double tiny = 1e-300;
  double c = 1, d = 1 / std::max(tiny, 1 - (a + b) * x / (a + 1)), value = d;
  for (int n = 1; n < 500; ++n) {
    const double even = n * (b - n) * x / ((a + 2 * n - 1) * (a + 2 * n));
    const double odd = -(a + n) * (a + b + n) * x / ((a + 2 * n) * (a + 2 * n + 1));
    for (const double term : {even, odd}) {
      d = 1 / (std::abs(1 + term * d) < tiny ? tiny : 1 + term * d);
      c = std::abs(1 + term / c) < tiny ? tiny : 1 + term / c;
      value *= c * d;
    }
    if (std::abs(c * d - 1) < 1e-15) break;
  }
  return value;
}

double incomplete_beta(double a, double b, double x) {
  if (x <= 0) return 0;
  if (x >= 1) return 1;
  const double front =
      std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log1p(-x));
  if (x < (a + 1) / (a + b + 2)) return front * beta_fraction(a, b, x) / a;
  return 1 - front * beta_fraction(b, a, 1 - x) / b;
}

bool two_places(std::span<const double> x) {
  const auto [low, high] = std::ranges::minmax(x);
  return high > low;
}

Estimate with_error(double value, double error, double freedom) {
  if (freedom < 1) return {value, none, none};
  const double half = student_limit(outside, freedom) * error;
  return {value, value - half, value + half};
}

Estimate fixed_value(double value) { return {value, value, value}; }

/// sigma_1 = sigma_3 + sqrt(a sigma_3 + b): both envelopes, with a = m sigma_c and b = s sigma_c^2.
struct Root {
  double a = 0, b = 0;
  double variance = 0;            ///< of a residual; 0 without freedom
  double aa = 0, ab = 0, bb = 0;  ///< inverse of the normal matrix
  double freedom = 0;
};

struct Normal {
  double aa = 0, ab = 0, bb = 0, ra = 0, rb = 0, squares = 0;
  bool valid = true;
};

Normal normal_of(std::span<const double> x, std::span<const double> y, double a, double b) {
  Normal n;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double inside = a * x[i] + b;
    if (!(inside > 0)) return {.valid = false};
    const double root = std::sqrt(inside), residual = y[i] - x[i] - root;
    const double da = x[i] / (2 * root), db = 1 / (2 * root);
    n.aa += da * da;
    n.ab += da * db;
    n.bb += db * db;
    n.ra += da * residual;
    n.rb += db * residual;
    n.squares += residual * residual;
  }
  return n;
}

// Levenberg and Marquardt, from the straight line through (sigma_1 - sigma_3)^2.
std::optional<Root> fit_root(std::span<const double> x, std::span<const double> y) {
  if (x.size() < 2 || x.size() != y.size() || !two_places(x)) return std::nullopt;
  std::vector<double> squared;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!std::isfinite(x[i]) || !std::isfinite(y[i])) return std::nullopt;
    squared.push_back((y[i] - x[i]) * (y[i] - x[i]));
  }
  const auto start = fit_line(x, squared);
  double a = start->slope.value, b = start->intercept.value;
  Normal now = normal_of(x, y, a, b);
  if (!now.valid) {
    a = 0;
    b = 0;
    for (const double value : squared) b += value / static_cast<double>(squared.size());
    now = normal_of(x, y, a, b);
    if (!now.valid) return std::nullopt;
  }
  double damping = 1e-6;
  for (int step = 0; step < 500 && damping < 1e12; ++step) {
    const double aa = now.aa * (1 + damping), bb = now.bb * (1 + damping);
    const double determinant = aa * bb - now.ab * now.ab;
    if (!(determinant > 0)) {
      damping *= 10;
      continue;
    }
    const double next_a = a + (bb * now.ra - now.ab * now.rb) / determinant;
    const double next_b = b + (aa * now.rb - now.ab * now.ra) / determinant;
    const Normal next = normal_of(x, y, next_a, next_b);
    if (!next.valid || next.squares > now.squares) {
      damping *= 10;
      continue;
    }
    const bool still = std::abs(next_a - a) <= 1e-13 * std::abs(a) && std::abs(next_b - b) <= 1e-13 * std::abs(b);
    a = next_a;
    b = next_b;
    now = next;
    damping = std::max(1e-12, damping / 10);
    if (still) break;
  }
  const double determinant = now.aa * now.bb - now.ab * now.ab;
  if (!(determinant > 0)) return std::nullopt;
  Root root{
      a, b, 0, now.bb / determinant, -now.ab / determinant, now.aa / determinant, static_cast<double>(x.size()) - 2};
  if (root.freedom > 0) root.variance = now.squares / root.freedom;
  return root;
}

// An estimate of a function of a and b with the derivatives da and db.
Estimate derived(const Root& root, double value, double da, double db) {
  const double variance = root.variance * (da * da * root.aa + 2 * da * db * root.ab + db * db * root.bb);
  return with_error(value, std::sqrt(std::max(0.0, variance)), root.freedom);
}

}  // namespace

bool Estimate::has_interval() const { return std::isfinite(low) && std::isfinite(high); }

double student_two_sided(double t, double freedom) {
  return incomplete_beta(0.5 * freedom, 0.5, freedom / (freedom + t * t));
}

double student_limit(double probability, double freedom) {
  double low = 0, high = 1;
  while (student_two_sided(high, freedom) > probability) high *= 2;
  for (int i = 0; i < 200 && high - low > 1e-14 * high; ++i) {
    const double middle = 0.5 * (low + high);
    (student_two_sided(middle, freedom) > probability ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

std::optional<LineFit> fit_line(std::span<const double> x, std::span<const double> y) {
  if (x.size() < 2 || x.size() != y.size() || !two_places(x)) return std::nullopt;
  const auto n = static_cast<double>(x.size());
  double mean_x = 0, mean_y = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    mean_x += x[i] / n;
    mean_y += y[i] / n;
  }
  double xx = 0, xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mean_x) * (x[i] - mean_x);
    xy += (x[i] - mean_x) * (y[i] - mean_y);
  }
  const double slope = xy / xx, intercept = mean_y - slope * mean_x;
  double squares = 0;
  for (std::size_t i = 0; i < x.size(); ++i) squares += std::pow(y[i] - intercept - slope * x[i], 2);
  LineFit fit;
  fit.points = x.size();
  const double freedom = n - 2;
  const double deviation = freedom > 0 ? std::sqrt(squares / freedom) : 0;
  const double slope_error = deviation / std::sqrt(xx);
  fit.slope = with_error(slope, slope_error, freedom);
  fit.intercept = with_error(intercept, deviation * std::sqrt(1 / n + mean_x * mean_x / xx), freedom);
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
  if (!root || !(root->b > 0)) return std::nullopt;
  const double c = std::sqrt(root->b);
  return EnvelopeFit{derived(*root, c, 0, 0.5 / c), derived(*root, root->a / c, 1 / c, -0.5 * root->a / (c * c * c)),
                     fixed_value(1), sigma_3.size()};
}

std::optional<EnvelopeFit> fit_peak_m(std::span<const double> sigma_3, std::span<const double> sigma_1,
                                      double sigma_c) {
  if (sigma_3.size() < 2 || sigma_3.size() != sigma_1.size() || !two_places(sigma_3) || !(sigma_c > 0))
    return std::nullopt;
  for (std::size_t i = 0; i < sigma_3.size(); ++i) {
    if (!std::isfinite(sigma_3[i]) || !std::isfinite(sigma_1[i])) return std::nullopt;
  }
  // Newton's method on the one slope, halving steps that leave the envelope's range or raise the sum of squares.
  const double b = sigma_c * sigma_c;
  double a = 10 * sigma_c;
  Normal now = normal_of(sigma_3, sigma_1, a, b);
  for (int step = 0; step < 200 && now.valid && now.aa > 0; ++step) {
    double change = now.ra / now.aa;
    Normal next = normal_of(sigma_3, sigma_1, a + change, b);
    for (int half = 0; half < 60 && (!next.valid || next.squares > now.squares); ++half) {
      change *= 0.5;
      next = normal_of(sigma_3, sigma_1, a + change, b);
    }
    if (!next.valid || next.squares > now.squares) break;
    a += change;
    now = next;
    if (std::abs(change) <= 1e-14 * std::abs(a)) break;
  }
  if (!now.valid || !(now.aa > 0)) return std::nullopt;
  // Points without pressure say nothing of m, and sigma_c is their mean: scatter is that of the others.
  double squares = 0, freedom = -1;
  for (std::size_t i = 0; i < sigma_3.size(); ++i) {
    if (!(sigma_3[i] > 0)) continue;
    squares += std::pow(sigma_1[i] - hoek_brown(sigma_3[i], sigma_c, a / sigma_c, 1), 2);
    ++freedom;
  }
  const double error = freedom > 0 ? std::sqrt(squares / freedom / now.aa) / sigma_c : 0;
  return EnvelopeFit{fixed_value(sigma_c), with_error(a / sigma_c, error, freedom), fixed_value(1), sigma_3.size()};
}

std::optional<EnvelopeFit> fit_damage_envelope(std::span<const double> sigma_3, std::span<const double> sigma_1,
                                               double sigma_c) {
  const auto root = fit_root(sigma_3, sigma_1);
  if (!root || !(sigma_c > 0)) return std::nullopt;
  const double square = sigma_c * sigma_c;
  return EnvelopeFit{fixed_value(sigma_c), derived(*root, root->a / sigma_c, 1 / sigma_c, 0),
                     derived(*root, root->b / square, 0, 1 / square), sigma_3.size()};
}

}  // namespace dem::analysis
