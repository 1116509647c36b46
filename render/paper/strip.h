#pragma once
// The strip below a scene: the directions of its axes and the bar of its colours; and a whole scene without spheres as a
// drawing.
#include "render/paper/paper.h"
#include "render/scene/scene.h"

namespace render {

bool has_strip(const Scene& scene);

/// As wide as the scene is shown, in px of the page.
Paper strip_of(const Scene& scene, const SceneResult& drawn);

/// A parallel view of a scene without spheres, with its strip. What lies behind is painted over by what lies before it.
Paper paper_of(const Scene& scene, const SceneResult& drawn);

}  // namespace render
