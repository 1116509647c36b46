#include "engine/texture/loading/gauge.h"

#include <algorithm>
#include <cmath>

namespace dem::texture {

StrainGauge::StrainGauge(const std::vector<Vec3>& position, const std::function<bool(const Vec3&)>& inside)
    : start_(position) {
  for (std::size_t i = 0; i < position.size(); ++i) {
    if (inside(position[i])) inside_.push_back(static_cast<std::int32_t>(i));
  }
}

std::array<double, 3> StrainGauge::read(const std::vector<Row8>& poses) const {
  std::array<double, 3> slope{};
  const auto n = static_cast<double>(inside_.size());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double mean_x = 0, mean_u = 0;
    for (const std::int32_t p : inside_) {
      const auto i = static_cast<std::size_t>(p);
      mean_x += start_[i][axis];
      mean_u += poses[i].v[axis] - start_[i][axis];
    }
    mean_x /= n;
    mean_u /= n;
    double xx = 0, xu = 0;
    for (const std::int32_t p : inside_) {
      const auto i = static_cast<std::size_t>(p);
      const double x = start_[i][axis] - mean_x;
      xx += x * x;
      xu += x * (poses[i].v[axis] - start_[i][axis] - mean_u);
    }
    slope[axis] = xx > 0 ? xu / xx : 0;
  }
  return slope;
}

MouthGauge::MouthGauge(const std::vector<Vec3>& position, double reach) {
  for (std::size_t i = 0; i < position.size(); ++i) {
    const auto& [x, y, z] = position[i];
    if (z > reach || std::abs(x) > reach) continue;
    Side& side = sides_[x < 0 ? 0 : 1];
    side.particles.push_back(static_cast<std::int32_t>(i));
    side.start += x;
  }
  for (Side& side : sides_) side.start /= static_cast<double>(std::max<std::size_t>(side.particles.size(), 1));
}

double MouthGauge::read(const std::vector<Row8>& poses) const {
  std::array<double, 2> moved{};
  for (std::size_t s = 0; s < 2; ++s) {
    if (sides_[s].particles.empty()) return 0;
    for (const std::int32_t p : sides_[s].particles) moved[s] += poses[static_cast<std::size_t>(p)].v[0];
    moved[s] = moved[s] / static_cast<double>(sides_[s].particles.size()) - sides_[s].start;
  }
  return moved[1] - moved[0];
}

}  // namespace dem::texture
