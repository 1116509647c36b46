#include "engine/texture/loading/gauge.h"

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

MouthGauge::MouthGauge(const std::vector<Vec3>& position, double reach) : start_(position) {
  for (std::size_t i = 0; i < position.size(); ++i) {
    const auto& [x, y, z] = position[i];
    if (z <= reach && std::abs(x) <= reach) sides_[x < 0 ? 0 : 1].push_back(static_cast<std::int32_t>(i));
  }
}

double MouthGauge::read(const std::vector<Row8>& poses) const {
  std::array<double, 2> moved{};
  for (std::size_t s = 0; s < 2; ++s) {
    if (sides_[s].empty()) return 0;
    const auto n = static_cast<double>(sides_[s].size());
    double mean_z = 0, mean_u = 0, zz = 0, zu = 0;
    for (const std::int32_t p : sides_[s]) {
      const auto i = static_cast<std::size_t>(p);
      mean_z += start_[i][2] / n;
      mean_u += (poses[i].v[0] - start_[i][0]) / n;
    }
    for (const std::int32_t p : sides_[s]) {
      const auto i = static_cast<std::size_t>(p);
      const double z = start_[i][2] - mean_z;
      zz += z * z;
      zu += z * (poses[i].v[0] - start_[i][0] - mean_u);
    }
    moved[s] = mean_u - (zz > 0 ? zu / zz * mean_z : 0);
  }
  return moved[1] - moved[0];
}

}  // namespace dem::texture
