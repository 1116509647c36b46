#pragma once
// The strain gauge: strains of the rock itself, away from the ends where it is held.
#include <cstdint>
#include <vector>

#include "engine/texture/solver/input.h"
#include "engine/texture/solver/particles.h"

namespace dem::texture {

/// Strains by least squares over the particles of the gauge: slopes of u_z over z, and of u_x, u_y over x, y.
class StrainGauge {
 public:
  /// Particles whose distance from mid-height is at most half of `length` (m).
  StrainGauge(const std::vector<Vec3>& position, double height, double length);
  /// Counts from these positions from now on.
  void restart(const std::vector<Vec3>& position) { start_ = position; }
  struct Strains {
    double axial = 0, lateral = 0;  ///< tension positive
  };
  [[nodiscard]] Strains read(const std::vector<Row8>& poses) const;

  template <class Archive>
  void archive(Archive& a) {
    a(start_, inside_);
  }

 private:
  std::vector<Vec3> start_;
  std::vector<std::int32_t> inside_;
};

}  // namespace dem::texture
