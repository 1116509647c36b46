#pragma once
// Spheres that no ray of a parallel view reaches, found before drawing: a packing shows a tenth of its spheres.
#include <vector>

#include "render/scene/scene.h"

namespace render {

/// A sphere in view coordinates (px).
struct ViewSphere {
  Point centre{};
  double radius = 0;
  double hiding_radius = 0;  ///< of the disc within which nothing behind the sphere is seen; 0: it hides nothing
  double top = 1e300;        ///< z of a cut that faces the eye: what is nearer is gone
};

/// False for spheres that are surely behind others. A picture of width x height px, origin in its middle.
std::vector<bool> seen(const std::vector<ViewSphere>& spheres, int width, int height);

}  // namespace render
