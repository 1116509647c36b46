#include "engine/texture/loading/gauge.h"

#include <array>
#include <cmath>

namespace dem::texture {

StrainGauge::StrainGauge(const std::vector<Vec3>& position, double height, double length) : start_(position) {
  for (std::size_t i = 0; i < position.size(); ++i) {
    if (std::abs(position[i][2] - height / 2) <= length / 2) inside_.push_back(static_cast<std::int32_t>(i));
  }
}

StrainGauge::Strains StrainGauge::read(const std::vector<Row8>& poses) const {
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
  return {slope[2], 0.5 * (slope[0] + slope[1])};
}

}  // namespace dem::texture
