// Packing and seeds of a specimen.
#include "engine/texture/specimen.h"

namespace dem::texture {

Genesis genesis(const PackingSettings& settings, const std::vector<MineralGrains>& minerals, double seed_scale,
                RunContext& context) {
  Genesis made;
  made.packing = pack(settings, context);
  made.seeds = seed_grains(settings.vessel, minerals, seed_scale, settings.seed, context);
  return made;
}

}  // namespace dem::texture
