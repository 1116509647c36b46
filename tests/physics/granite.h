#pragma once
// Packing settings and minerals of Lac du Bonnet granite (Zhao et al. 2021, Table 4), for tests of specimens.
#include "engine/texture/specimen.h"

namespace dem::texture {

inline PackingSettings granite_packing(double diameter, std::uint64_t seed = 1) {
  PackingSettings settings;
  settings.vessel = {diameter, 2 * diameter};
  settings.radius_min = 0.35e-3;
  settings.modulus = 58e9;
  settings.pressure = 0.01 * settings.modulus;
  settings.seed = seed;
  return settings;
}

/// Plagioclase, alkali feldspar, quartz, biotite.
inline std::vector<MineralGrains> granite_minerals() {
  return {{0.17, 2e-3, 6e-3}, {0.48, 3e-3, 4e-3}, {0.29, 2e-3, 3e-3}, {0.06, 2e-3, 2e-3}};
}

}  // namespace dem::texture
