#pragma once
// A plain reference for the sheet's solver: exact Newton on the true tangent, factorised anew for every step with
// Eigen's sparse LDL^T. Shares no code with the solver but the sheet's data.
#include <vector>

#include "engine/sheet/sheet.h"

namespace reference {

/// A polycrystal of 30 Voronoi grains: k ~ N(1, 0.25) a grain, thresholds 0.006 U(0.4, 1.6), halved between grains.
dem::sheet::Sheet polycrystal(int columns, std::uint64_t seed = 1, double spread = 0.6);

struct Run {
  std::vector<int> slots;  ///< in the order of breaking
  std::vector<int> steps;  ///< load step of each
  double worst = 0;        ///< largest unbalanced over largest spring force after any relaxation
  int contacts = 0;        ///< most broken pairs in contact at any time
};

/// Pure shear in steps of 0.001 until `breaks` springs are broken.
Run run(dem::sheet::Sheet sheet, int breaks);

}  // namespace reference
