#include "engine/analysis/mohr.h"

#include <cmath>
#include <numbers>

namespace dem::analysis {
namespace {

constexpr double degree = std::numbers::pi / 180;

double angle_of(double slope) { return std::asin((slope - 1) / (slope + 1)) / degree; }

}  // namespace

MeanAndDeviator invariants(double sigma_3, double sigma_1) { return {(sigma_1 + 2 * sigma_3) / 3, sigma_1 - sigma_3}; }

std::vector<OnPlane> mohr_circle(double sigma_3, double sigma_1, int steps) {
  const double middle = 0.5 * (sigma_1 + sigma_3), radius = 0.5 * (sigma_1 - sigma_3);
  std::vector<OnPlane> circle;
  for (int k = 0; k <= steps; ++k) {
    const double angle = std::numbers::pi * k / steps;
    circle.push_back({middle - radius * std::cos(angle), k == 0 || k == steps ? 0 : radius * std::sin(angle)});
  }
  return circle;
}

OnPlane touching(double sigma_3, double sigma_1, double slope) {
  const double above = (sigma_1 - sigma_3) / (slope + 1);
  return {sigma_3 + above, above * std::sqrt(slope)};
}

double Coulomb::shear_at(double normal) const { return cohesion + normal * std::tan(friction_angle.value * degree); }

std::optional<Coulomb> fit_coulomb(std::span<const double> sigma_3, std::span<const double> sigma_1) {
  const auto line = fit_line(sigma_3, sigma_1);
  if (!line || !(line->slope.value > 1) || !(line->intercept.value > 0)) return std::nullopt;
  // An interval may reach below a slope of 1, where there is no friction.
  const auto bound = [](double slope) { return slope > 0 ? angle_of(slope) : -90.0; };
  Coulomb fit;
  fit.line = *line;
  fit.friction_angle = {angle_of(line->slope.value), line->slope.low, line->slope.high};
  if (line->slope.has_interval()) {
    fit.friction_angle.low = bound(line->slope.low);
    fit.friction_angle.high = bound(line->slope.high);
  }
  fit.cohesion = line->intercept.value / (2 * std::sqrt(line->slope.value));
  return fit;
}

}  // namespace dem::analysis
