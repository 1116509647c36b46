#pragma once
// What is read off a test: strain gauges, moduli, characteristic stresses.
//
// Signs: stress and axial strain positive in the sense of the test, lateral strain negative when the specimen widens,
// volumetric strain = axial + 2 lateral (contraction positive in compression).
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "engine/texture/solver/assembly.h"

namespace dem::texture {

/// One row of /history. SI units.
struct HistoryRow {
  double step = 0, time = 0;
  double platen_strain = 0, axial_strain = 0, lateral_strain = 0;
  double axial_stress = 0;         ///< mean of both ends over the initial area
  double stress_imbalance = 0;     ///< difference of both ends
  double confining_pressure = 0;   ///< of the jacket on the specimen
  std::array<double, 4> cracks{};  ///< intra tension, intra shear, inter tension, inter shear
  Ledger ledger;
  [[nodiscard]] double volumetric_strain() const { return axial_strain + 2 * lateral_strain; }
};

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

/// Characteristic values of a curve; stresses in Pa. Absent where the curve does not have them.
struct Characteristics {
  std::size_t peak = 0;                             ///< row of the largest stress
  std::optional<double> young_modulus;              ///< least squares between 10 and 30 % of the peak
  std::optional<double> poisson_ratio;              ///< secant at half the peak (compression)
  std::optional<std::size_t> initiation_stiffness;  ///< row: axial stiffness leaves its early plateau
  std::optional<double> stress_at_strain;           ///< at 0.1 % axial strain
  std::optional<std::size_t> initiation_cracks;     ///< row: 1 % of the cracks present at the peak
  std::optional<std::size_t> initiation_volume;     ///< row: reversal of the crack volumetric strain
  std::optional<std::size_t> damage;                ///< row: largest volumetric strain before the peak
};

/// `departure`: share by which the axial stiffness must leave its plateau (mean over 10 to 25 % of the peak). Shares of the
/// peak are counted from the confining pressure (Pa), where the test starts.
Characteristics characterise(const std::vector<HistoryRow>& history, double departure, bool compression,
                             double confining_pressure = 0);

/// Axial stiffness of Eq. 9: (sigma - sigma_0) / (epsilon - epsilon_0), from the first row; NaN below a strain of 5e-5.
double axial_stiffness(const std::vector<HistoryRow>& history, std::size_t row);

}  // namespace dem::texture
