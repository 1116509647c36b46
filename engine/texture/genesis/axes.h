#pragma once
// The shape that grains have once they are grown. Growth rounds off what the mask gave them: the nominal aspect ratio is
// that of the ellipsoids alone.
#include <vector>

#include "engine/texture/genesis/specimen.h"

namespace dem::texture {

/// Of the solid ellipsoid with the second moments of a grain's particles: semi-axes in m, the longest first.
struct OwnAxes {
  Vec3 axis{0, 0, 1};  ///< unit vector along the longest
  double semi_long = 0, semi_middle = 0, semi_short = 0;
};

/// One for each of `count` grains.
std::vector<OwnAxes> own_axes(const Packing& packing, const GrainMap& grains, std::size_t count);

/// Aspect ratio from the second moments of all grains about their own centres, summed: along `axis`, a unit vector, over
/// those across it. The longest over the shorter axes of each grain would be above 1 also for grains without a shape: one
/// of few particles always has a longest axis.
double realised_aspect_ratio(const Packing& packing, const GrainMap& grains, std::size_t count, const Vec3& axis);

}  // namespace dem::texture
