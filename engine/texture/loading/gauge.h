#pragma once
// The strain gauge: strains of the rock itself, away from the ends where it is held.
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "engine/texture/solver/input.h"
#include "engine/texture/solver/particles.h"

namespace dem::texture {

/// Strains by least squares over the particles of the gauge: slopes of u_x, u_y, u_z over x, y, z.
class StrainGauge {
 public:
  StrainGauge(const std::vector<Vec3>& position, const std::function<bool(const Vec3&)>& inside);
  /// Counts from these positions from now on.
  void restart(const std::vector<Vec3>& position) { start_ = position; }
  /// Along x, y, z; tension positive.
  [[nodiscard]] std::array<double, 3> read(const std::vector<Row8>& poses) const;

  template <class Archive>
  void archive(Archive& a) {
    a(start_, inside_);
  }

 private:
  std::vector<Vec3> start_;
  std::vector<std::int32_t> inside_;
};

/// How far the two sides of the plane x = 0 have moved apart at the lower face: u_x at z = 0, by least squares over z of the
/// particles of either side.
class MouthGauge {
 public:
  /// Particles up to `reach` (m) from the plane and above z = 0; 0: there is no gauge.
  MouthGauge(const std::vector<Vec3>& position, double reach);
  [[nodiscard]] double read(const std::vector<Row8>& poses) const;  ///< m

 private:
  std::vector<Vec3> start_;
  std::array<std::vector<std::int32_t>, 2> sides_;  ///< particles; x < 0, x >= 0
};

}  // namespace dem::texture
