// Fits of lines and strength envelopes, against known parameters and a worked example.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "engine/analysis/fits.h"
#include "engine/analysis/mohr.h"

using doctest::Approx;

TEST_CASE("a line through a worked example has its slope, intervals and p-value") {
  // x 1 to 5, y 2 4 5 4 5: means 3 and 4, Sxx 10, Sxy 6; residuals squared 2.4, so the slope's error is sqrt(0.8 / 10) and
  // the intercept's sqrt(0.8 (1/5 + 9/10)); t for three degrees of freedom is 3.182446 (tables of Student's t).
  const auto fit = dem::analysis::fit_line(std::vector{1.0, 2.0, 3.0, 4.0, 5.0}, std::vector{2.0, 4.0, 5.0, 4.0, 5.0});
  REQUIRE(fit);
  CHECK(fit->slope.value == Approx(0.6));
  CHECK(fit->intercept.value == Approx(2.2));
  CHECK(fit->slope.high == Approx(0.6 + 3.182446 * std::sqrt(0.08)).epsilon(1e-6));
  CHECK(fit->slope.low == Approx(0.6 - 3.182446 * std::sqrt(0.08)).epsilon(1e-6));
  CHECK(fit->intercept.high == Approx(2.2 + 3.182446 * std::sqrt(0.88)).epsilon(1e-6));
  CHECK(fit->p_value == Approx(0.12402).epsilon(1e-4));
  CHECK(fit->at(10) == Approx(8.2));
}

TEST_CASE("Student's t agrees with the tables") {
  CHECK(dem::analysis::student_limit(0.05, 1) == Approx(12.7062).epsilon(1e-5));
  CHECK(dem::analysis::student_limit(0.05, 10) == Approx(2.228139).epsilon(1e-6));
  CHECK(dem::analysis::student_limit(0.01, 4) == Approx(4.604095).epsilon(1e-6));
  CHECK(dem::analysis::student_two_sided(0, 5) == Approx(1));
  CHECK(dem::analysis::student_two_sided(-2.228139, 10) == Approx(0.05).epsilon(1e-6));
  CHECK(dem::analysis::student_limit(dem::analysis::student_two_sided(3.5, 7), 7) == Approx(3.5).epsilon(1e-14));
}

TEST_CASE("Student's t says NaN, 0 or infinity where there is no answer, and throws nothing") {
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  CHECK(std::isnan(dem::analysis::student_two_sided(nan, 3)));
  CHECK(std::isnan(dem::analysis::student_two_sided(1, 0)));
  CHECK(std::isnan(dem::analysis::student_two_sided(1, nan)));
  CHECK(dem::analysis::student_two_sided(infinity, 3) == 0);
  CHECK(dem::analysis::student_two_sided(-infinity, 3) == 0);
  CHECK(std::isnan(dem::analysis::student_limit(0.05, 0)));
  CHECK(std::isnan(dem::analysis::student_limit(0.05, -1)));
  CHECK(std::isnan(dem::analysis::student_limit(nan, 3)));
  CHECK(std::isnan(dem::analysis::student_limit(3, 3)));
  CHECK(dem::analysis::student_limit(0, 3) == infinity);
  CHECK(dem::analysis::student_limit(1, 3) == 0);
}

TEST_CASE("two points give a line without an interval; one place gives none") {
  const auto fit = dem::analysis::fit_line(std::vector{0.0, 2.0}, std::vector{1.0, 5.0});
  REQUIRE(fit);
  CHECK(fit->slope.value == Approx(2));
  CHECK_FALSE(fit->slope.has_interval());
  CHECK(std::isnan(fit->p_value));
  CHECK_FALSE(dem::analysis::fit_line(std::vector{3.0, 3.0}, std::vector{1.0, 5.0}));
  CHECK_FALSE(dem::analysis::fit_line(std::vector<double>{}, std::vector<double>{}));
}

TEST_CASE("envelopes recover the parameters that made their points") {
  const std::vector<double> sigma_3{0, 5, 10, 20, 40, 60};
  for (const auto& [sigma_c, m] : {std::pair{206.0, 29.0}, {122.2, 15.0}, {418.0, 25.0}, {60.0, 0.5}}) {
    CAPTURE(m);
    std::vector<double> peak, damage;
    for (const double p : sigma_3) {
      peak.push_back(dem::analysis::hoek_brown(p, sigma_c, m, 1));
      damage.push_back(dem::analysis::hoek_brown(p, sigma_c, 0.55 * m, 0.6));
    }
    const auto intact = dem::analysis::fit_peak_envelope(sigma_3, peak);
    REQUIRE(intact);
    CHECK(std::abs(intact->sigma_c.value / sigma_c - 1) < 1e-6);
    CHECK(std::abs(intact->m.value / m - 1) < 1e-6);
    CHECK(intact->s.value == 1);
    CHECK(intact->m.high - intact->m.low < 1e-6 * m);
    const auto damaged = dem::analysis::fit_damage_envelope(sigma_3, damage, sigma_c);
    REQUIRE(damaged);
    CHECK(std::abs(damaged->m.value / (0.55 * m) - 1) < 1e-6);
    CHECK(std::abs(damaged->s.value / 0.6 - 1) < 1e-6);
    CHECK(damaged->at(30) == Approx(dem::analysis::hoek_brown(30, sigma_c, 0.55 * m, 0.6)));
  }
}

TEST_CASE("scattered points leave the envelope inside its interval, and no nearby envelope is closer") {
  const std::vector<double> sigma_3{0, 5, 10, 20, 40, 60}, scatter{3, -4, 2, 5, -6, 1};
  std::vector<double> sigma_1;
  for (std::size_t i = 0; i < sigma_3.size(); ++i)
    sigma_1.push_back(dem::analysis::hoek_brown(sigma_3[i], 206, 29, 1) + scatter[i]);
  const auto fit = dem::analysis::fit_peak_envelope(sigma_3, sigma_1);
  REQUIRE(fit);
  CHECK(fit->m.low < 29);
  CHECK(fit->m.high > 29);
  CHECK(fit->sigma_c.low < 206);
  CHECK(fit->sigma_c.high > 206);
  const auto squares = [&](double sigma_c, double m) {
    double sum = 0;
    for (std::size_t i = 0; i < sigma_3.size(); ++i)
      sum += std::pow(sigma_1[i] - dem::analysis::hoek_brown(sigma_3[i], sigma_c, m, 1), 2);
    return sum;
  };
  const double best = squares(fit->sigma_c.value, fit->m.value);
  for (const double step : {-0.1, 0.1}) {
    CHECK(squares(fit->sigma_c.value + step, fit->m.value) > best);
    CHECK(squares(fit->sigma_c.value, fit->m.value + step) > best);
  }
}

TEST_CASE("m alone is found when sigma_c is known, and no nearby m is closer") {
  const std::vector<double> sigma_3{0, 5, 10, 20, 40, 60}, scatter{3, -4, 2, 5, -6, 1};
  std::vector<double> exact, sigma_1;
  for (std::size_t i = 0; i < sigma_3.size(); ++i) {
    exact.push_back(dem::analysis::hoek_brown(sigma_3[i], 206, 29, 1));
    sigma_1.push_back(exact[i] + scatter[i]);
  }
  const auto known = dem::analysis::fit_peak_m(sigma_3, exact, 206);
  REQUIRE(known);
  CHECK(known->m.value == Approx(29).epsilon(1e-9));
  CHECK(known->sigma_c.value == 206);
  const auto fit = dem::analysis::fit_peak_m(sigma_3, sigma_1, 206);
  REQUIRE(fit);
  CHECK(fit->m.low < 29);
  CHECK(fit->m.high > 29);
  const auto squares = [&](double m) {
    double sum = 0;
    for (std::size_t i = 0; i < sigma_3.size(); ++i)
      sum += std::pow(sigma_1[i] - dem::analysis::hoek_brown(sigma_3[i], 206, m, 1), 2);
    return sum;
  };
  for (const double step : {-0.05, 0.05}) CHECK(squares(fit->m.value + step) > squares(fit->m.value));
  // A point without pressure lies on every envelope with its own sigma_c: two points leave nothing to judge m by.
  const auto one = dem::analysis::fit_peak_m(std::vector{0.0, 20.0}, std::vector{206.0, 400.0}, 206);
  REQUIRE(one);
  CHECK_FALSE(one->m.has_interval());
  CHECK_FALSE(dem::analysis::fit_peak_m(sigma_3, sigma_1, std::nan("")));
  CHECK_FALSE(dem::analysis::fit_peak_m(std::vector{10.0}, std::vector{200.0}, 206));
}

TEST_CASE("what cannot be fitted is not") {
  CHECK_FALSE(dem::analysis::fit_peak_envelope(std::vector{10.0, 10.0}, std::vector{200.0, 210.0}));
  CHECK_FALSE(dem::analysis::fit_peak_envelope(std::vector{0.0, 10.0}, std::vector{200.0, std::nan("")}));
  CHECK_FALSE(dem::analysis::fit_damage_envelope(std::vector{0.0, 10.0}, std::vector{100.0, 150.0}, 0));
  const auto two = dem::analysis::fit_peak_envelope(std::vector{0.0, 20.0},
                                                    std::vector{206.0, dem::analysis::hoek_brown(20, 206, 29, 1)});
  REQUIRE(two);
  CHECK(two->m.value == Approx(29));
  CHECK_FALSE(two->m.has_interval());
}

TEST_CASE("circles of a straight envelope touch it, and Coulomb's numbers come back") {
  const double phi = 50 * 3.14159265358979323846 / 180, c = 30, n = (1 + std::sin(phi)) / (1 - std::sin(phi));
  const std::vector<double> sigma_3{0, 10, 20, 40};
  std::vector<double> sigma_1;
  for (const double s : sigma_3) sigma_1.push_back(2 * c * std::sqrt(n) + n * s);
  const auto fit = dem::analysis::fit_coulomb(sigma_3, sigma_1);
  REQUIRE(fit);
  CHECK(fit->cohesion == Approx(c));
  CHECK(fit->friction_angle.value == Approx(50));
  CHECK(fit->friction_angle.low == Approx(50));
  for (std::size_t i = 0; i < sigma_3.size(); ++i) {
    const auto at = dem::analysis::touching(sigma_3[i], sigma_1[i], n);
    CHECK(at.shear == Approx(fit->shear_at(at.normal)));
    CHECK(std::hypot(at.normal - 0.5 * (sigma_1[i] + sigma_3[i]), at.shear) == Approx(0.5 * (sigma_1[i] - sigma_3[i])));
  }
  CHECK_FALSE(dem::analysis::fit_coulomb(std::vector{0.0, 10.0}, std::vector{100.0, 105.0}));  // no friction
  CHECK_FALSE(dem::analysis::fit_coulomb(std::vector{5.0, 5.0}, std::vector{100.0, 105.0}));
}

TEST_CASE("a circle of Mohr runs from the small to the large stress, and p and q are those of a cylinder") {
  const auto circle = dem::analysis::mohr_circle(10, 110, 4);
  REQUIRE(circle.size() == 5);
  CHECK(circle.front().normal == Approx(10));
  CHECK(circle[2].normal == Approx(60));
  CHECK(circle[2].shear == Approx(50));
  CHECK(circle.back().normal == Approx(110));
  CHECK(circle.back().shear == 0);
  CHECK(dem::analysis::invariants(10, 110).p == Approx(130.0 / 3));
  CHECK(dem::analysis::invariants(10, 110).q == Approx(100));
}
