#pragma once
// The history of a test, sample by sample. SI units.
//
// Signs: stress and axial strain positive in the sense of the test, lateral strain negative when the specimen widens in
// compression, volumetric strain = axial + 2 lateral (contraction positive in compression).
#include <array>
#include <cstdint>
#include <vector>

#include "engine/texture/solver/account.h"

namespace dem::texture {

/// One row of /history.
struct HistoryRow {
  double step = 0, time = 0;
  double platen_strain = 0, axial_strain = 0, lateral_strain = 0;
  double axial_stress = 0;        ///< mean of both ends over the area at the beginning of the test proper
  double stress_imbalance = 0;    ///< difference of both ends
  double confining_pressure = 0;  ///< of the jacket on the specimen; in direct shear the normal stress
  double opening = 0;  ///< m, of the mouth of a notch (Test::mouth); in direct shear the rise of the upper half
  double phase = 0;    ///< of loops (Test::loops): 1 on the way down, 2 back up to where it was turned, else 0
  std::array<double, 4> cracks{};  ///< intra tension, intra shear, inter tension, inter shear
  Ledger ledger;
  [[nodiscard]] double volumetric_strain() const { return axial_strain + 2 * lateral_strain; }
  [[nodiscard]] double all_cracks() const { return cracks[0] + cracks[1] + cracks[2] + cracks[3]; }
};

/// Displacements at one sample, kept at regular strains so that named moments can be shown afterwards.
struct Frame {
  std::int64_t row = 0;             ///< of the history
  std::vector<float> displacement;  ///< m, three a particle
  template <class Archive>
  void archive(Archive& a) {
    a(row, displacement);
  }
};

}  // namespace dem::texture
