#pragma once
// Least squares with 95 % confidence intervals: straight lines and the strength envelope of Hoek and Brown
//   sigma_1 = sigma_3 + sigma_c sqrt(m sigma_3 / sigma_c + s)            (Zhao et al. 2021, Eq. 10)
// Residuals are those of sigma_1. Intervals are those of Student's t; of the envelope, in linear approximation at the fit.
#include <cstddef>
#include <optional>
#include <span>

namespace dem::analysis {

/// A fitted value and its interval; the interval is NaN where there are as many unknowns as points.
struct Estimate {
  double value = 0, low = 0, high = 0;
  [[nodiscard]] bool has_interval() const;
};

/// Mean of repeats with its interval by Student's t: of three values or more. NaN of none.
Estimate mean_of(std::span<const double> values);

/// The mean of `a` over that of `b`, of unlike samples: its interval from both scatters to first order, with the degrees of
/// freedom of Welch and Satterthwaite; of three values or more each. NaN of none.
Estimate ratio_of_means(std::span<const double> a, std::span<const double> b);

struct LineFit {
  Estimate intercept, slope;
  double p_value = 0;    ///< of the slope against none, two-sided; NaN without an interval
  double r_squared = 0;  ///< share of the scatter of y that the line takes; NaN where y is constant
  std::size_t points = 0;
  [[nodiscard]] double at(double x) const { return intercept.value + slope.value * x; }
};

/// Slopes of seeds: cases of one seed share a specimen's packing, so that each seed gives one, and it is these that scatter.
struct Trend {
  Estimate slope;
  double p_value = 0;  ///< against none, two-sided; NaN without an interval
  std::size_t seeds = 0;
  [[nodiscard]] bool is_clear() const { return slope.has_interval() && (slope.low > 0 || slope.high < 0); }
};
Trend paired_trend(std::span<const double> slopes);

/// Nothing with fewer than two different x.
std::optional<LineFit> fit_line(std::span<const double> x, std::span<const double> y);

struct EnvelopeFit {
  Estimate sigma_c, m, s;  ///< what was fixed has itself for an interval
  std::size_t points = 0;
  [[nodiscard]] double at(double sigma_3) const;
};

double hoek_brown(double sigma_3, double sigma_c, double m, double s);

/// sigma_c and m, with s = 1: intact rock. Nothing with fewer than two different sigma_3, or where no envelope fits.
std::optional<EnvelopeFit> fit_peak_envelope(std::span<const double> sigma_3, std::span<const double> sigma_1);
/// m alone, with s = 1 and sigma_c given: the uniaxial strength, as the text after Eq. 10 has it.
std::optional<EnvelopeFit> fit_peak_m(std::span<const double> sigma_3, std::span<const double> sigma_1, double sigma_c);
/// m and s, with sigma_c given: crack damage below the envelope of the peak.
std::optional<EnvelopeFit> fit_damage_envelope(std::span<const double> sigma_3, std::span<const double> sigma_1,
                                               double sigma_c);

/// Probability that |t| is larger, and the |t| that is exceeded with a probability.
double student_two_sided(double t, double freedom);
double student_limit(double probability, double freedom);

}  // namespace dem::analysis
