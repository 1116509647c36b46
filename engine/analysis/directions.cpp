#include "engine/analysis/directions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

namespace dem::analysis {
namespace {

constexpr double degree = std::numbers::pi / 180;

double dot(const Direction& a, const Direction& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Direction unit(const Direction& v) {
  const double length = std::sqrt(dot(v, v));
  return {v[0] / length, v[1] / length, v[2] / length};
}

}  // namespace

double Poles::effective() const {
  double sum = 0, squares = 0;
  for (const double w : weight) sum += w, squares += w * w;
  return squares > 0 ? sum * sum / squares : 0;
}

Poles poles_of(const dem::Table& cracks, int place, int mode) {
  const auto normal = cracks.real("normal"), area = cracks.real("area");
  const auto places = cracks.integer("place"), modes = cracks.integer("mode"), contact = cracks.integer("contact");
  std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> known;  // contact and mode
  Poles poles;
  for (std::size_t i = 0; i < cracks.rows(); ++i) {
    if ((place >= 0 && places[i] != place) || (mode >= 0 && modes[i] != mode)) continue;
    const Direction n{normal[3 * i], normal[3 * i + 1], normal[3 * i + 2]};
    if (!(dot(n, n) > 0) || !(area[i] > 0)) continue;
    const auto [at, fresh] = known.try_emplace({contact[i], modes[i]}, poles.weight.size());
    if (fresh) {
      poles.direction.push_back(unit(n));
      poles.weight.push_back(0);
    }
    poles.weight[at->second] += area[i];
  }
  return poles;
}

PoleDensity::PoleDensity(Poles poles) : poles_(std::move(poles)) {
  constexpr double sigma = 3, most = 441;  // 9 / (441 + 9) of the hemisphere
  f_ = 2 * (1 + std::min(poles_.effective(), most) / (sigma * sigma));
  // Mean of the kernel, and of its square, over all directions.
  const double mean = -std::expm1(-f_) / f_, square = -std::expm1(-2 * f_) / (2 * f_);
  double sum = 0;
  for (const double w : poles_.weight) sum += w;
  scale_ = 1 / (sum * mean);
  scatter_ = std::sqrt((square - mean * mean) / poles_.effective()) / mean;
}

double PoleDensity::times_uniform(const Direction& at) const {
  double sum = 0;
  for (std::size_t i = 0; i < poles_.weight.size(); ++i) {
    const double exponent = f_ * (std::abs(dot(at, poles_.direction[i])) - 1);
    if (exponent > -30) sum += poles_.weight[i] * std::exp(exponent);
  }
  return sum * scale_;
}

double Maximum::dip() const { return std::acos(std::min(1.0, std::abs(pole[2]))) / degree; }

double Maximum::dip_direction() const {
  // The plane dips away from the side to which its pole points down.
  const double angle = std::atan2(-pole[1], -pole[0]) / degree;
  return angle < 0 ? angle + 360 : angle;
}

Maximum maximum_of(const PoleDensity& density) {
  constexpr int half = 30;
  Maximum best;
  double x = 0, y = 0;
  const auto look = [&](double u, double v) {
    const Direction at = from_schmidt(u, v);
    const double value = density.times_uniform(at);
    if (!(value > best.times_uniform)) return false;
    best.times_uniform = value;
    best.pole = at;
    x = u, y = v;
    return true;
  };
  for (int i = -half; i <= half; ++i) {
    for (int j = -half; j <= half; ++j) {
      if (i * i + j * j <= half * half) look(static_cast<double>(i) / half, static_cast<double>(j) / half);
    }
  }
  for (double step = 0.5 / half; step > 1e-5;) {
    const double u = x, v = y;
    const bool better = look(u + step, v) || look(u - step, v) || look(u, v + step) || look(u, v - step);
    if (!better) step *= 0.5;
  }
  if (best.pole[2] > 0) best.pole = {-best.pole[0], -best.pole[1], -best.pole[2]};
  best.deviations = density.deviations(best.times_uniform);
  return best;
}

std::vector<double> strikes_of(const Poles& poles, std::size_t classes) {
  std::vector<double> share(classes, 0.0);
  double all = 0;
  for (std::size_t i = 0; i < poles.weight.size(); ++i) {
    const Direction& n = poles.direction[i];
    const double length = poles.weight[i] * std::hypot(n[0], n[1]);
    if (!(length > 0)) continue;
    double strike = std::atan2(n[0], -n[1]) / std::numbers::pi;  // a quarter turn from the pole, in half turns
    strike -= std::floor(strike);
    const auto k = std::min(classes - 1, static_cast<std::size_t>(strike * static_cast<double>(classes)));
    share[k] += length;
    all += length;
  }
  for (double& s : share) s = all > 0 ? s / all : std::numeric_limits<double>::quiet_NaN();
  return share;
}

std::array<double, 2> schmidt(Direction pole) {
  if (pole[2] > 0) pole = {-pole[0], -pole[1], -pole[2]};
  const double across = std::hypot(pole[0], pole[1]);
  if (!(across > 0)) return {0, 0};
  const double radius = std::sqrt(1 + pole[2]);
  return {radius * pole[0] / across, radius * pole[1] / across};
}

Direction from_schmidt(double x, double y) {
  const double square = std::min(2.0, x * x + y * y), down = 1 - square;
  if (!(square > 0)) return {0, 0, -1};
  const double across = std::sqrt(std::max(0.0, 1 - down * down)) / std::sqrt(square);
  return {across * x, across * y, -down};
}

}  // namespace dem::analysis
